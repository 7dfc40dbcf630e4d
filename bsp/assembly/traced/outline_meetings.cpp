// SPDX-License-Identifier: Apache-2.0
//
// Of ten segments on a facet, far most pairs lie apart, and nearly all of these have boxes that do
// not meet in the facet's projection. Single precision finds that for four pairs at once, without a
// bound: what a box reaches to is rounded, and rounding keeps the order. If the rounded least of
// one is larger than the rounded most of the other, so are the exact ones.
//
// Those that are left cross where each has its ends on both sides of the other one's line. These
// signs come from doubles with a bound, and what has no sure answer ends the attempt. The point is
// then taken on the one of the two segments that determines it better.
//
// The bound, with u = 2^-53 and E the largest error of the four ends. The value of a point is
// du y - dv x, with (du, dv) the way along the line and (x, y) the way from its start. Each of
// these differences is off by 2E for its ends, and by a factor of 1 + u. So a product, say
// du y, has an error of
//     2E (|du| + |y|) + 4E^2 + 3.1u |du y|
// besides products of E and u, and the difference of both by another u of it. That makes
//     2E (|du| + |dv| + |x| + |y| + 4E) + 4.1u (|du y| + |dv x|);
// 2.001 E and 8u are taken, which pays for the products and for rounding the bound itself.

#include <trisect/bsp/assembly/traced/outline_meetings.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/double2.h>

namespace trisect::detail {

namespace {

// The axis along which a segment is longest, and the way along it with its sign.
std::pair<std::size_t, double> longest_way(const OutlineSegment& s) {
    std::pair<std::size_t, double> longest(0, s.at[1]->c[0] - s.at[0]->c[0]);
    for (std::size_t k = 1; k < 3; ++k) {
        const double way = s.at[1]->c[k] - s.at[0]->c[k];
        if (std::fabs(way) > std::fabs(longest.second)) longest = {k, way};
    }
    return longest;
}

}  // namespace

OutlinePlane::OutlinePlane(const std::array<const LatticePoint*, 3>& corners) {
    origin = corners[0]->doubles();
    const Vector3 v = minus(corners[1]->doubles(), origin);
    const Vector3 w = minus(corners[2]->doubles(), origin);
    for (std::size_t k = 0; k < 3; ++k) {
        const double s = v[(k + 1) % 3] * w[(k + 2) % 3];
        const double t = v[(k + 2) % 3] * w[(k + 1) % 3];
        normal[k] = s - t;
        minor[k] = std::fabs(s) + std::fabs(t);
    }
}

OutlinePlane::OutlinePlane(const Plane& plane, const std::array<double, 3>& near) : origin(near) {
    for (std::size_t k = 0; k < 3; ++k) {
        normal[k] = plane.approx_normal(static_cast<int>(k));
        minor[k] = std::fabs(normal[k]);
    }
}

std::size_t OutlinePlane::dominant_axis() const {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
    return axis;
}

bool OutlineMeetings::find(const OutlinePlane& facet, std::span<const OutlineSegment> segments,
                           std::size_t cutters) {
    segments_ = segments;
    points_.clear();
    meetings_.clear();
    compared_ = 0;
    first_.assign(segments.size() + 1, 0);
    if (cutters < 2) return true;
    if (!set_axes(facet)) return false;
    make_boxes(facet);
    for (std::uint32_t a = 0; a < segments.size(); ++a)
        if (!compare_with_all(a)) return false;
    return points_.empty() || sort_meetings();
}

// False when doubles cannot decide how the facet lies.
bool OutlineMeetings::set_axes(const OutlinePlane& facet) {
    const std::size_t k = facet.dominant_axis();
    axes_ = {(k + 1) % 3, (k + 2) % 3};
    if (facet.normal[k] < 0) std::swap(axes_[0], axes_[1]);
    return std::fabs(facet.normal[k]) > minor_rounding * facet.minor[k];
}

void OutlineMeetings::make_boxes(const OutlinePlane& facet) {
    constexpr float far = std::numeric_limits<float>::infinity();
    boxes_.assign((segments_.size() + 3) / 4,
                  {{all_lanes(far), all_lanes(far)}, {all_lanes(-far), all_lanes(-far)}});
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        const Approximation& from = *segments_[s].at[0];
        const Approximation& to = *segments_[s].at[1];
        BoxRow& row = boxes_[s / 4];
        for (std::size_t k = 0; k < 2; ++k) {
            const std::size_t axis = axes_[k];
            const double a = from.c[axis];
            const double b = to.c[axis];
            // From the facet, where single precision goes farthest.
            const double low = std::min(a - from.error, b - to.error) - facet.origin[axis];
            const double high = std::max(a + from.error, b + to.error) - facet.origin[axis];
            row.low[k][s % 4] = static_cast<float>(low);
            row.high[k][s % 4] = static_cast<float>(high);
        }
    }
}

// With those that come after it.
bool OutlineMeetings::compare_with_all(std::uint32_t a) {
    const BoxRow& own = boxes_[a / 4];
    const std::size_t lane = a % 4;
    const std::array<Float4, 2> low{all_lanes(own.low[0][lane]), all_lanes(own.low[1][lane])};
    const std::array<Float4, 2> high{all_lanes(own.high[0][lane]), all_lanes(own.high[1][lane])};
    const std::uint32_t cutter = segments_[a].cutter;
    unsigned after = 14U << lane & 15U;
    for (std::uint32_t r = a / 4; r < boxes_.size(); ++r, after = 15U) {
        const BoxRow& row = boxes_[r];
        const Mask4 apart = (row.low[0] > high[0]) | (low[0] > row.high[0]) |
                            (row.low[1] > high[1]) | (low[1] > row.high[1]);
        for (unsigned left = ~bits_of(apart) & after; left != 0; left &= left - 1) {
            const std::uint32_t b = 4 * r + static_cast<std::uint32_t>(std::countr_zero(left));
            if (segments_[b].cutter != cutter && !compare(a, b)) return false;
        }
    }
    return true;
}

// False when it is uncertain whether two segments cross.
bool OutlineMeetings::compare(std::uint32_t a, std::uint32_t b) {
    ++compared_;
    const std::array<std::uint32_t, 2> pair{a, b};
    std::array<Values, 2> values;
    for (std::size_t i = 0; i < 2; ++i) {
        values[i] = values_of(segments_[pair[1 - i]], segments_[pair[i]]);
        if (values[i].known && (values[i].at[0] > 0) == (values[i].at[1] > 0)) return true;
    }
    return values[0].known && values[1].known && add_point(pair, values);
}

// Of both ends: positive to the left of the line.
OutlineMeetings::Values OutlineMeetings::values_of(const OutlineSegment& line,
                                                   const OutlineSegment& s) const {
    const auto [u, v] = axes_;
    const Approximation& p = *line.at[0];
    const Approximation& q = *line.at[1];
    const Approximation& from = *s.at[0];
    const Approximation& to = *s.at[1];
    const double du = q.c[u] - p.c[u];
    const double dv = q.c[v] - p.c[v];
    const Double2 x = Double2{from.c[u], to.c[u]} - both(p.c[u]);
    const Double2 y = Double2{from.c[v], to.c[v]} - both(p.c[v]);
    const auto size = [](Double2 a) { return larger(a, -a); };
    const Double2 left = both(du) * y;
    const Double2 right = both(dv) * x;
    const Double2 value = left - right;
    const double e = std::max(std::max(p.error, q.error), std::max(from.error, to.error));
    const Double2 ways = both(std::fabs(du) + std::fabs(dv) + 4 * e) + (size(x) + size(y));
    const Double2 error =
        both(minor_rounding) * (size(left) + size(right)) + both(2.001 * e) * ways;
    Values out;
    out.at = {value[0], value[1]};
    out.error = error[0] + error[1];
    out.known = where_at_most(size(value), error) == 0;
    return out;
}

bool OutlineMeetings::add_point(const std::array<std::uint32_t, 2>& segments,
                                const std::array<Values, 2>& values) {
    const auto spread = [&](std::size_t i) {
        return std::fabs(values[i].at[0]) + std::fabs(values[i].at[1]);
    };
    const auto length = [&](std::size_t i) {
        return std::fabs(longest_way(segments_[segments[i]]).second);
    };
    const std::size_t better =
        values[1].error * length(1) * spread(0) < values[0].error * length(0) * spread(1) ? 1 : 0;
    const Values& v = values[better];
    const OutlineSegment& s = segments_[segments[better]];
    Point& point = points_.emplace_back();
    point.segments = segments;
    for (std::size_t i = 0; i < 2; ++i) {
        point.opens[i] = values[i].at[1] > 0;  // what is open is to the left
        ++first_[segments[i] + 1];
    }
    return interpolate(*s.at[0], v.at[0], *s.at[1], v.at[1], v.error, point.at);
}

// Those of one segment in their order along it; false when it is uncertain.
bool OutlineMeetings::sort_meetings() {
    for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
    next_.assign(first_.begin(), first_.end() - 1);
    meetings_.resize(2 * points_.size());
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
        const Point& point = points_[p];
        for (std::size_t i = 0; i < 2; ++i)
            meetings_[next_[point.segments[i]]++] = {point.segments[1 - i], p, point.opens[i], 0,
                                                     0};
    }
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        if (first_[s + 1] - first_[s] > 1 && !sort_along(segments_[s], of(s))) return false;
    return true;
}

bool OutlineMeetings::sort_along(const OutlineSegment& segment, std::span<Meeting> run) const {
    const auto [axis, way] = longest_way(segment);
    for (Meeting& m : run) {
        const double c = points_[m.point].at.c[axis];
        m.along = way > 0 ? c : -c;
    }
    std::ranges::sort(run, {}, &Meeting::along);
    const auto error = [&](std::size_t i) { return points_[run[i].point].at.error; };
    for (std::size_t i = 1; i < run.size(); ++i)
        if (!(run[i].along - run[i - 1].along > bound_slack * (error(i - 1) + error(i))))
            return false;
    return true;
}

}  // namespace trisect::detail
