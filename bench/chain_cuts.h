// SPDX-License-Identifier: Apache-2.0
//
// A stock, the balls that cut it one after the other, and where questions are asked beside them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

#include "shapes.h"

/// Every ball meets about 300 facets of the stock, whatever their number. All coordinates are
/// multiples of 2^-30, as a user's data on one grid is.
class ChainCuts {
public:
    enum class Shape : std::uint8_t {
        Sphere,  ///< refined, of radius 1
        /// Two wide rough sides, [-1, 1] along x and y, 1 thick. About each cut it is the same at
        /// every size but for the scale, while a larger sphere is flatter there.
        Plate
    };

    /// A stock of about 20 · 4^level triangles. `path`: cuts follow each other instead of lying all
    /// over the stock. `small_holder`: the holder is as large as a ball, so that it is near to as
    /// many facets whatever their number; else it has a quarter of the stock's radius.
    ChainCuts(Shape shape, int level, bool path, bool small_holder = false)
        : shape_(shape), path_(path), small_holder_(small_holder), level_(level) {
        const double facets =
            shape == Shape::Sphere ? 20 * std::pow(4, level) : 2.0 * squares() * squares();
        const double area = shape == Shape::Sphere ? 4 * M_PI : 4;
        radius_ = shape == Shape::Sphere ? std::sqrt(300.0 / (5 * std::pow(4, level)))
                                         : std::sqrt(300.0 * area / (M_PI * facets));
    }

    [[nodiscard]] trisect::PolygonMesh stock() const {
        return on_grid(shape_ == Shape::Sphere ? shapes::icosphere(level_) : plate());
    }
    /// About the origin, beside the stock once it is moved.
    [[nodiscard]] trisect::PolygonMesh holder() const {
        return on_grid(scaled(shapes::icosphere(4), holder_radius()));
    }
    [[nodiscard]] double holder_radius() const { return small_holder_ ? radius_ : 0.25; }
    [[nodiscard]] trisect::PolygonMesh ball_at(const trisect::Point3d& at) const {
        return on_grid(shapes::moved(scaled(ball_, radius_), at));
    }
    [[nodiscard]] double radius() const { return radius_; }

    /// Where the cut of this number is.
    [[nodiscard]] trisect::Point3d place(int cut) {
        if (!path_) return on_surface();
        const double t = 0.7 * radius_ * cut;
        if (shape_ == Shape::Plate)
            return {std::fmod(t, 2 * reach) - reach,
                    std::fmod(std::floor(t / (2 * reach)) * radius_, 2 * reach) - reach, 0};
        const double z = 1 - std::fmod(2.0 * t * radius_ / (2 * M_PI), 2.0);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        return {r * std::cos(t), r * std::sin(t), z};
    }
    /// The i-th of so many places that cover the stock evenly.
    [[nodiscard]] trisect::Point3d spread(int i, int count) const {
        constexpr double golden_angle = 2.399963229728653;
        const double part = (i + 0.5) / count;
        if (shape_ == Shape::Plate)
            return {reach * (2 * part - 1), reach * (2 * std::fmod(i * 0.618033988749895, 1.0) - 1),
                    0};
        const double z = 1 - 2 * part;
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z};
    }
    [[nodiscard]] trisect::Point3d in_box() {
        trisect::Point3d p{};
        for (double& c : p) c = 2 * random_.uniform() - 1;
        if (shape_ == Shape::Plate) p[2] = 0.5 * (p[2] - 1);
        return p;
    }
    /// A point of the surface, moved off it by at most `width`, either way.
    [[nodiscard]] trisect::Point3d near_surface(double width) {
        const trisect::Point3d at = on_surface();
        return above(at, width * (2 * random_.uniform() - 1));
    }

    /// A point `height` off the surface at a place, or below it.
    [[nodiscard]] trisect::Point3d above(const trisect::Point3d& at, double height) const {
        if (shape_ == Shape::Plate) return {at[0], at[1], at[2] + height};
        return {at[0] * (1 + height), at[1] * (1 + height), at[2] * (1 + height)};
    }
    /// The same point beside the place, by four radii of a ball.
    [[nodiscard]] trisect::Point3d aside(const trisect::Point3d& at, double height) const {
        trisect::Point3d p = above(at, height);
        if (shape_ == Shape::Plate) {
            p[0] += std::copysign(4 * radius_, -at[0]);
            return p;
        }
        // Turned about the axis that is most across it.
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::fabs(at[k]) < std::fabs(at[axis])) axis = k;
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        const double x = p[u];
        p[u] = std::cos(4 * radius_) * x - std::sin(4 * radius_) * p[v];
        p[v] = std::sin(4 * radius_) * x + std::cos(4 * radius_) * p[v];
        return p;
    }
    /// A point in the middle of the stock below a place.
    [[nodiscard]] trisect::Point3d middle(const trisect::Point3d& at) const {
        if (shape_ == Shape::Plate) return {at[0], at[1], -0.5};
        return {0, 0, 0};
    }

private:
    /// Of a plate, where cuts are: farther out, questions would come near its rim.
    static constexpr double reach = 0.7;

    [[nodiscard]] trisect::Point3d on_surface() {
        if (shape_ == Shape::Plate) {
            const double x = reach * (2 * random_.uniform() - 1);
            return {x, reach * (2 * random_.uniform() - 1), 0};
        }
        const double z = 2 * random_.uniform() - 1;
        const double a = 2 * M_PI * random_.uniform();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    /// Along each side of a plate.
    [[nodiscard]] int squares() const {
        return static_cast<int>(std::lround(std::sqrt(5 * std::pow(4, level_))));
    }
    /// Heights differ by a tenth of the width of a square.
    [[nodiscard]] trisect::PolygonMesh plate() const {
        const auto n = static_cast<std::uint32_t>(squares());
        const double step = 2.0 / n;
        shapes::Random random(2);
        trisect::PolygonMesh mesh;
        for (const double z : {0.0, -1.0})
            for (std::uint32_t i = 0; i <= n; ++i)
                for (std::uint32_t j = 0; j <= n; ++j)
                    mesh.points.push_back(
                        {step * i - 1, step * j - 1, z + 0.1 * step * (random.uniform() - 0.5)});
        const auto top = [n](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
        const std::uint32_t below = (n + 1) * (n + 1);
        const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                std::uint32_t d) {
            mesh.add_face(std::array{a, b, c});
            mesh.add_face(std::array{a, c, d});
        };
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) {
                square(top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1));
                square(below + top(i, j), below + top(i, j + 1), below + top(i + 1, j + 1),
                       below + top(i + 1, j));
            }
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto side = [&](std::uint32_t a, std::uint32_t b) {
                square(below + a, below + b, b, a);
            };
            side(top(i, 0), top(i + 1, 0));
            side(top(i + 1, n), top(i, n));
            side(top(0, i + 1), top(0, i));
            side(top(n, i), top(n, i + 1));
        }
        return mesh;
    }
    static trisect::PolygonMesh scaled(trisect::PolygonMesh m, double by) {
        for (trisect::Point3d& p : m.points)
            for (double& c : p) c *= by;
        return m;
    }
    static trisect::PolygonMesh on_grid(trisect::PolygonMesh m) {
        constexpr double unit = 0x1p-30;
        for (trisect::Point3d& p : m.points)
            for (double& c : p) c = std::round(c / unit) * unit;
        return m;
    }

    Shape shape_;
    bool path_;
    bool small_holder_;
    int level_;
    double radius_ = 0;
    shapes::Random random_{1};
    trisect::PolygonMesh ball_ = shapes::icosphere(3);
};
