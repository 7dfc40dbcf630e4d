// SPDX-License-Identifier: Apache-2.0
//
// Bounds. A corner coordinate is a double; the segment's position p
// has an error of at most e = 2^-53 |p|. A difference d = c - p errs by at most 2^-53 |d| + e, and
// e <= at_error_. A determinant m = a b - c d of differences errs, to first order, by
//   3 · 2^-53 (|a b| + |c d|) + e (|a| + |b| + |c| + |d|);
// twice that, with 2^-50 for 3 · 2^-53, covers the rest.

#include <trisect/bsp/cells/trace/axis_trace.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <trisect/bsp/cells/trace/trace_winding.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

AxisTrace::AxisTrace(const FinePoint& from, const FinePoint& to, int axis)
    : from_(from), to_(to), axis_(static_cast<std::size_t>(axis)) {
    for (std::size_t i = 0; i < 2; ++i) {
        at_[i] = rounded_position(from.c[(axis_ + 1 + i) % 3]);
        at_error_ = std::max(at_error_, std::fabs(at_[i]) * last_place);
    }
}

void AxisTrace::add(const PolygonRef& polygon) {
    if (!decide(polygon)) uncertain_.push_back(polygon);
}

bool AxisTrace::decide(const PolygonRef& polygon) {
    if (polygon.fragment != nullptr || polygon.source->is_half_space()) return false;
    std::array<std::array<double, 2>, 3> d;
    std::array<std::int64_t, 3> height;
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& c = polygon.source->corner(polygon.facet, i);
        height[static_cast<std::size_t>(i)] = position_of(coordinate(c, axis_));
        d[static_cast<std::size_t>(i)] = {coordinate(c, (axis_ + 1) % 3).to_double() - at_[0],
                                          coordinate(c, (axis_ + 2) % 3).to_double() - at_[1]};
    }
    int positive = 0;
    int negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& a = d[i];
        const auto& b = d[(i + 1) % 3];
        const double p = a[0] * b[1];
        const double q = a[1] * b[0];
        const double m = p - q;
        const double error =
            0x1p-49 * (std::fabs(p) + std::fabs(q)) +
            2 * at_error_ * (std::fabs(a[0]) + std::fabs(a[1]) + std::fabs(b[0]) + std::fabs(b[1]));
        if (!(std::fabs(m) > error)) return false;
        ++(m > 0 ? positive : negative);
    }
    ++detail::counters_of_thread<PredicateCounters>.filtered;
    if (positive != 0 && negative != 0) return true;  // missed
    // Met by the line. By the segment, if all of the facet's height is between its ends.
    const auto [lo, hi] = std::minmax({height[0], height[1], height[2]});
    const std::int64_t low = std::min(from_.c[axis_], to_.c[axis_]);
    const std::int64_t high = std::max(from_.c[axis_], to_.c[axis_]);
    const bool whole = polygon.source->is_whole();
    if (fine_upper(hi, whole) < low || fine_lower(lo, whole) > high) return true;
    if (fine_lower(lo, whole) <= low || fine_upper(hi, whole) >= high) return false;
    // The support's normal along the axis has the sign of the determinants. Going up through a
    // facet that faces up is leaving.
    const bool leaving = (positive != 0) == (to_.c[axis_] > from_.c[axis_]);
    decided_ += leaving != polygon.flipped ? -1 : 1;
    return true;
}

std::optional<int> AxisTrace::change(bool flipped) const {
    const int sure = flipped ? -decided_ : decided_;
    if (uncertain_.empty()) return sure;
    const auto rest = trace_winding(uncertain_, flipped, from_, to_);
    if (!rest) return std::nullopt;
    return sure + *rest;
}

}  // namespace trisect::detail
