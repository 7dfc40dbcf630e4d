// SPDX-License-Identifier: Apache-2.0
//
// Two convex sets are disjoint if their projections onto some axis are. For a triangle and a box
// the candidates are the box's axes (its boxes were compared before), the triangle's normal and the
// nine cross products of edges and axes (Akenine-Möller 2001, "Fast 3D triangle-box overlap
// testing").
//
// Rounding: coordinates relative to the box's centre are below 2^55 with an error of at most 4; a
// projection is a sum of at most six products, so it errs by less than 2^-48 of the sum of its
// terms' magnitudes. The margin is 2^-40 of that sum plus a growth of the box by 8 units.

#include <trisect/bsp/detail/facet_in_cell.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Is the axis separating, by more than the margin?
bool separates(const Vector& axis, const std::array<Vector, 3>& corners, const Vector& half) {
    double lo = 0;
    double hi = 0;
    double terms = 0;
    double radius = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double at = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            at += axis[k] * corners[i][k];
            terms += std::fabs(axis[k] * corners[i][k]);
        }
        lo = i == 0 ? at : std::min(lo, at);
        hi = i == 0 ? at : std::max(hi, at);
    }
    for (std::size_t k = 0; k < 3; ++k) radius += std::fabs(axis[k]) * half[k];
    const double margin = 0x1p-40 * (terms + radius);
    return lo > radius + margin || hi < -radius - margin;
}

}  // namespace

bool certainly_misses(const PolygonRef& ref, const Box& box) {
    if (ref.source->is_half_space()) return false;
    Vector centre{};
    Vector half{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto lo = static_cast<double>(box.lo[k]);
        const auto hi = static_cast<double>(box.hi[k]);
        centre[k] = 0.5 * (lo + hi);
        half[k] = 0.5 * (hi - lo) + 8;
    }
    std::array<Vector, 3> corners{};
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& p = ref.source->corner(ref.facet, i);
        for (int k = 0; k < 3; ++k)
            corners[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
                static_cast<double>(p[k]) - centre[static_cast<std::size_t>(k)];
    }
    std::array<Vector, 3> edges{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) edges[i][k] = corners[(i + 1) % 3][k] - corners[i][k];
    if (separates(cross(edges[0], edges[1]), corners, half)) return true;
    for (const Vector& e : edges)
        for (std::size_t k = 0; k < 3; ++k) {
            Vector axis{};
            axis[k] = 1;
            if (separates(cross(e, axis), corners, half)) return true;
        }
    return false;
}

}  // namespace trisect::detail
