// SPDX-License-Identifier: Apache-2.0
//
// Surfaces of revolution. The quarter circle ((1 - t²), 2t) / (1 + t²) has control points (1, 0),
// (1, 1), (0, 1) and weights 1, 1, 2 (Piegl and Tiller, The NURBS Book, 7.3). Quarters follow each
// other around; their weights at a common end differ by a factor of two, which sides may.

#include <trisect/brep/curved/curved_shapes.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/circle.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

struct Control2d {
    double x = 0;
    double y = 0;
    double weight = 1;
};
using Arc = std::array<Control2d, 3>;

// The quarter of the unit circle from angle `quarter` · 90°.
Arc quarter_circle(int quarter) {
    Arc arc{{{1, 0, 1}, {1, 1, 1}, {0, 1, 2}}};
    for (int k = 0; k < quarter; ++k)
        for (Control2d& c : arc) c = {-c.y, c.x, c.weight};
    return arc;
}

// A profile in the plane of x (distance from the axis) and y (height) turned around the z axis. It
// runs so that its outside is on the right.
void revolve(const Arc& profile, std::vector<BezierPatch>& patches) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Arc around = quarter_circle(quarter);
        std::vector<Point3d> points;
        std::vector<double> weights;
        for (const Control2d& a : around)
            for (const Control2d& p : profile) {
                points.push_back({p.x * a.x, p.x * a.y, p.y});
                weights.push_back(a.weight * p.weight);
            }
        patches.emplace_back(2, 2, std::move(points), std::move(weights));
    }
}

}  // namespace

CurvedBoundary make_curved_sphere(double radius) {
    detail::require_positive(radius, "the radius of a sphere");
    std::vector<BezierPatch> patches;
    for (const int quarter : {3, 0}) {
        Arc profile = quarter_circle(quarter);
        for (Control2d& c : profile) c = {radius * c.x, radius * c.y, c.weight};
        revolve(profile, patches);
    }
    return CurvedBoundary(std::move(patches));
}

CurvedBoundary make_curved_torus(double major_radius, double minor_radius) {
    detail::require_positive(minor_radius, "the minor radius of a torus");
    detail::require_positive(major_radius, "the major radius of a torus");
    if (!(minor_radius < major_radius))
        throw UsageError("the minor radius of a torus must be smaller than the major one");
    std::vector<BezierPatch> patches;
    for (int quarter = 0; quarter < 4; ++quarter) {
        Arc profile = quarter_circle(quarter);
        for (Control2d& c : profile)
            c = {major_radius + minor_radius * c.x, minor_radius * c.y, c.weight};
        revolve(profile, patches);
    }
    return CurvedBoundary(std::move(patches));
}

}  // namespace trisect
