// SPDX-License-Identifier: Apache-2.0
//
// A refined sphere and the balls that cut it, one after the other.
#pragma once

#include <cmath>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

#include "shapes.h"

/// Every ball meets about 300 facets of the stock, whatever their number. All coordinates are
/// multiples of 2^-30, as a user's data on one grid is.
class ChainCuts {
public:
    /// A stock of 20 · 4^level triangles. `path`: cuts follow each other along a spiral instead of
    /// lying all over the stock. `small_holder`: the holder is as large as a ball, so that it is
    /// near to as many facets whatever their number; else it has a quarter of the stock's radius.
    ChainCuts(int level, bool path, bool small_holder = false)
        : path_(path),
          small_holder_(small_holder),
          radius_(std::sqrt(300.0 / (5 * std::pow(4, level)))),
          level_(level) {}

    [[nodiscard]] trisect::PolygonMesh stock() const { return on_grid(shapes::icosphere(level_)); }
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
        if (!path_) return on_sphere(1);
        const double t = 0.7 * radius_ * cut;
        const double z = 1 - std::fmod(2.0 * t * radius_ / (2 * M_PI), 2.0);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        return {r * std::cos(t), r * std::sin(t), z};
    }
    [[nodiscard]] trisect::Point3d on_sphere(double radius) {
        const double z = 2 * random_.uniform() - 1;
        const double a = 2 * M_PI * random_.uniform();
        const double r = std::sqrt(1 - z * z);
        return {radius * r * std::cos(a), radius * r * std::sin(a), radius * z};
    }
    /// The i-th of so many points that cover the unit sphere evenly.
    [[nodiscard]] static trisect::Point3d on_spiral(int i, int count) {
        const double z = 1 - (2.0 * i + 1) / count;
        const double a = 2.399963229728653 * i;  // the golden angle
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    [[nodiscard]] trisect::Point3d in_cube() {
        trisect::Point3d p{};
        for (double& c : p) c = 2 * random_.uniform() - 1;
        return p;
    }
    [[nodiscard]] double uniform() { return random_.uniform(); }

    [[nodiscard]] static trisect::Point3d times(trisect::Point3d p, double by) {
        for (double& c : p) c *= by;
        return p;
    }

private:
    static trisect::PolygonMesh scaled(trisect::PolygonMesh m, double by) {
        for (trisect::Point3d& p : m.points) p = times(p, by);
        return m;
    }
    static trisect::PolygonMesh on_grid(trisect::PolygonMesh m) {
        constexpr double unit = 0x1p-30;
        for (trisect::Point3d& p : m.points)
            for (double& c : p) c = std::round(c / unit) * unit;
        return m;
    }

    bool path_;
    bool small_holder_;
    double radius_;
    int level_;
    shapes::Random random_{1};
    trisect::PolygonMesh ball_ = shapes::icosphere(3);
};
