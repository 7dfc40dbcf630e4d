// SPDX-License-Identifier: Apache-2.0
//
// Two convex sets are disjoint if their projections onto some axis are. For a triangle and a box
// the candidates are the box's axes (its boxes were compared before), the triangle's normal and the
// nine cross products of edges and axes (Akenine-Möller 2001, "Fast 3D triangle-box overlap
// testing").
//
// Rounding: coordinates relative to the box's centre are below 2^55 with an error of at most 4,
// made good by growing the box by 8 units. A projection onto a cross product of an edge and an axis
// is a sum of four products of an edge and a coordinate; with the largest_component of either its
// terms are bounded for all axes at once. The margin is 2^-40 of that bound, a thousand times the
// rounding.

#include <trisect/bsp/cells/facet_in_cell.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// A triangle with the box's centre as origin, and the box's half extents.
struct Pair {
    std::array<Vector3, 3> corners;
    std::array<Vector3, 3> edges;
    Vector3 half;
    double reach = 0;  // largest_component coordinate of a corner or half extent
    double step = 0;   // largest_component coordinate of an edge
};

// Does the cross product of edge i and axis k separate? Its coordinates are those of the edge
// perpendicular to the axis, turned by a quarter. The two ends of the edge have the same
// projection.
bool edge_separates(const Pair& p, std::size_t i, std::size_t k, double margin) {
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    const Vector3& e = p.edges[i];
    const Vector3& a = p.corners[i];
    const Vector3& c = p.corners[(i + 2) % 3];
    const double at_edge = e[m] * a[l] - e[l] * a[m];
    const double at_corner = e[m] * c[l] - e[l] * c[m];
    const double radius = std::fabs(e[m]) * p.half[l] + std::fabs(e[l]) * p.half[m] + margin;
    return std::min(at_edge, at_corner) > radius || std::max(at_edge, at_corner) < -radius;
}

// A whole plane. Its coefficients are rounded, and so are the value at the box's centre and the
// reach of the box's corners: all of that is below 2^-50 of the sum of magnitudes.
bool plane_misses(const Plane& plane, const Box& box) {
    double at = plane.approx_offset();
    double radius = 0;
    double size = std::fabs(at);
    for (std::size_t k = 0; k < 3; ++k) {
        const double n = plane.approx_normal(static_cast<int>(k));
        const auto lo = static_cast<double>(box.lo[k]);
        const auto hi = static_cast<double>(box.hi[k]);
        const double centre = 0.5 * (lo + hi);
        const double half = 0.5 * (hi - lo) + 8;
        at += n * centre;
        radius += std::fabs(n) * half;
        size += std::fabs(n) * (std::fabs(centre) + half);
    }
    return std::fabs(at) > radius + 0x1p-48 * size;
}

bool plane_separates(const Pair& p) {
    const Vector3 n = cross(p.edges[0], p.edges[1]);
    double at = 0;
    double radius = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        at += n[k] * p.corners[0][k];
        radius += std::fabs(n[k]) * p.half[k];
    }
    return std::fabs(at) > radius + 0x1p-38 * p.step * p.step * p.reach;
}

}  // namespace

bool certainly_misses(const PolygonRef& ref, const Box& box) {
    if (ref.source->is_half_space()) return plane_misses(ref.source->support(ref.facet), box);
    Pair p;
    Vector3 centre{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto lo = static_cast<double>(box.lo[k]);
        const auto hi = static_cast<double>(box.hi[k]);
        centre[k] = 0.5 * (lo + hi);
        p.half[k] = 0.5 * (hi - lo) + 8;
    }
    p.reach = largest_component(p.half);
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& c = ref.source->corner(ref.facet, i);
        Vector3& v = p.corners[static_cast<std::size_t>(i)];
        v = minus(c.doubles(), centre);
        p.reach = std::max(p.reach, largest_component(v));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            p.edges[i][k] = p.corners[(i + 1) % 3][k] - p.corners[i][k];
        p.step = std::max(p.step, largest_component(p.edges[i]));
    }
    if (plane_separates(p)) return true;
    const double margin = 0x1p-40 * 8 * p.step * p.reach;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (edge_separates(p, i, k, margin)) return true;
    return false;
}

}  // namespace trisect::detail
