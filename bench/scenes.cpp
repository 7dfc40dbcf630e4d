// SPDX-License-Identifier: Apache-2.0

#include "scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace scenes {

namespace {

using trisect::Point3d;
using trisect::PolygonMesh;

struct Box {
    Point3d low{1e300, 1e300, 1e300};
    Point3d high{-1e300, -1e300, -1e300};
};

Box box_of(const PolygonMesh& mesh) {
    Box box;
    for (const Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], p[k]);
            box.high[k] = std::max(box.high[k], p[k]);
        }
    return box;
}

using Matrix = std::array<Point3d, 3>;

Matrix rotation(const Point3d& axis, double degrees) {
    const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    const double q = 1 - c;
    const double x = axis[0] / length;
    const double y = axis[1] / length;
    const double z = axis[2] / length;
    return {{{c + x * x * q, x * y * q - z * s, x * z * q + y * s},
             {y * x * q + z * s, c + y * y * q, y * z * q - x * s},
             {z * x * q - y * s, z * y * q + x * s, c + z * z * q}}};
}

Point3d times(const Matrix& m, const Point3d& p) {
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = m[k][0] * p[0] + m[k][1] * p[1] + m[k][2] * p[2];
    return out;
}

Point3d on_sphere(const Point3d& p) {
    const double scale = 1 / std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return {scale * p[0], scale * p[1], scale * p[2]};
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class Midpoints {
public:
    explicit Midpoints(std::vector<Point3d>& points) : points_(points) {}
    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const auto [at, inserted] =
            index_.insert({std::minmax(a, b), static_cast<std::uint32_t>(points_.size())});
        if (inserted) {
            const Point3d p = points_[a];
            const Point3d q = points_[b];
            points_.push_back(on_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
        }
        return at->second;
    }

private:
    std::vector<Point3d>& points_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> index_;
};

}  // namespace

PolygonMesh turned(const PolygonMesh& mesh) {
    const Box box = box_of(mesh);
    const Matrix m = rotation({1, 2, 3}, 37);
    Point3d centre{};
    for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.5 * (box.low[k] + box.high[k]);
    const Point3d turned_centre = times(m, centre);
    Point3d shift{};
    for (std::size_t k = 0; k < 3; ++k)
        shift[k] = centre[k] - turned_centre[k] + 0.1 * (box.high[k] - box.low[k]);
    PolygonMesh out = mesh;
    for (Point3d& p : out.points) {
        p = times(m, p);
        for (std::size_t k = 0; k < 3; ++k) p[k] += shift[k];
    }
    return out;
}

PolygonMesh icosphere(int level) {
    const double p = (1 + std::sqrt(5.0)) / 2;
    PolygonMesh mesh;
    mesh.points = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                   {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
    for (Point3d& q : mesh.points) q = on_sphere(q);
    Triangles triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int i = 0; i < level; ++i) {
        Midpoints midpoints(mesh.points);
        Triangles finer;
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = midpoints.between(a, b);
            const std::uint32_t bc = midpoints.between(b, c);
            const std::uint32_t ca = midpoints.between(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    for (const auto& [a, b, c] : triangles) mesh.add_triangle(a, b, c);
    return mesh;
}

PolygonMesh moved(PolygonMesh mesh, const Point3d& by) {
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
    return mesh;
}

Point3d along_1_2_3(double length) {
    const double unit = length / std::sqrt(14.0);
    return {unit, 2 * unit, 3 * unit};
}

Size size_of(const PolygonMesh& mesh) {
    using Real = long double;
    using Vector = std::array<Real, 3>;
    const Box box = box_of(mesh);
    const auto at = [&](std::uint32_t v) {
        Vector out{};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = Real{mesh.points[v][k]} - Real{0.5} * (Real{box.low[k]} + Real{box.high[k]});
        return out;
    };
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Vector& a, const Vector& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    Real volume = 0;
    Real area = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 2; i < loop.size(); ++i) {
            const Vector a = at(loop[0]);
            Vector u = at(loop[i - 1]);
            Vector v = at(loop[i]);
            for (std::size_t k = 0; k < 3; ++k) u[k] -= a[k], v[k] -= a[k];
            const Vector normal = cross(u, v);
            volume += dot(a, normal);
            area += std::sqrt(dot(normal, normal));
        }
    }
    return {static_cast<double>(volume / 6), static_cast<double>(area / 2)};
}

}  // namespace scenes
