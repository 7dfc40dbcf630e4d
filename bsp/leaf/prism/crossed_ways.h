// SPDX-License-Identifier: Apache-2.0
//
// Crossings of side faces with a ray in the figure's plane.
//
// The ray, a way out of the figure, leads from a point along the first of the two coordinates,
// upwards. An end of a side face at the same second coordinate counts as below it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// Whether the way from a corner crosses a side face; exact.
[[nodiscard]] inline bool crosses_way(const PrismSideFace& w, const FlatCorner& p) {
    if ((w.from.v > p.v) == (w.to.v > p.v)) return false;
    return (turn(w.from, w.to, p) > 0) == (w.to.v > w.from.v);
}

/// The same for a point in doubles that is off by at most `error` in each coordinate; nothing when
/// they cannot decide. Every difference of coordinates rounds once, whether they are whole or not:
/// `slack` pays for that in the second coordinate, minor_rounding in the turn, which moves by
/// |du| + |dv| at most for each unit by which the point does.
[[nodiscard]] inline std::optional<bool> crosses_way(const PrismSideFace& w,
                                                     const std::array<double, 2>& p, double error) {
    const double from_v = w.from.v.to_double() - p[1];
    const double to_v = w.to.v.to_double() - p[1];
    const double slack = 1.001 * error + last_place * (std::fabs(from_v) + std::fabs(to_v));
    if ((from_v > slack && to_v > slack) || (from_v < -slack && to_v < -slack)) return false;
    if (std::fabs(from_v) <= slack || std::fabs(to_v) <= slack) return std::nullopt;
    const double du = w.to.u.to_double() - w.from.u.to_double();
    const double dv = w.to.v.to_double() - w.from.v.to_double();
    const double s = du * -from_v;
    const double t = dv * (p[0] - w.from.u.to_double());
    const double bound = minor_rounding * (std::fabs(s) + std::fabs(t)) +
                         1.001 * error * (std::fabs(du) + std::fabs(dv));
    if (std::fabs(s - t) <= bound) return std::nullopt;
    return (s > t) == (dv > 0);
}

/// A point in 1/192 lattice units (cell.h), as it is seen along the axis.
using FlatFinePoint = std::array<std::int64_t, 2>;

/// The same from such a point; exact.
[[nodiscard]] bool crosses_way(const PrismSideFace& w, const FlatFinePoint& p);

/// The sign of a coordinate minus a position in 1/192 lattice units; exact.
[[nodiscard]] int compare(Coordinate c, std::int64_t position);

}  // namespace trisect::detail
