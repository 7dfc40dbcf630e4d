// SPDX-License-Identifier: Apache-2.0
//
// Boundaries in general position cross in closed polylines. On a facet they leave paths of
// segments, from one point of its outline to another or closed, and only there the winding number
// of an operand changes. Segments of one operand hang together by name, at the edges that pierce
// the facet; those of two operands meet inside of both where each has its ends on both sides of the
// other one's plane.
//
// So one walk around the facet's outline has at every point the cutters that contain it: a cutter
// of which a segment ends there contains one side and leaves the other one open, whatever it does
// elsewhere. From the outline it goes on along the paths, where a cutter changes at its meetings.
// What none contains bounds the open part. No winding number is ever traced, and no point is made
// that is not a vertex, but for meetings under a third cutter.
//
// The cutters that contain a closed path come from a path that it meets, or else from a straight
// segment from a corner. Whether a cutter with nothing but closed paths contains the facet around
// them is decided by the sign of the area that they enclose, since outermost paths enclose all
// others.
//
// Everything is computed in doubles with a bound. What has no sure answer ends the attempt.
//
// Meetings are found pair by pair (outline_meetings.cpp). QuickCSG (Douze, Franco, Raffin 2017)
// starts from the same vertices, but locates each of them; walking from one to the next needs no
// query.

#include <trisect/bsp/assembly/traced/facet_outline.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

bool FacetOutline::trace(const std::array<const LatticePoint*, 3>& corners,
                         std::span<const OutlineSegment> segments, const ExactOutline* exact) {
    corners_ = corners;
    segments_ = segments;
    exact_ = exact;
    edges_.clear();
    has_projection_ = false;
    cutters_ = 0;
    for (const OutlineSegment& s : segments)
        cutters_ = std::max(cutters_, std::size_t{s.cutter} + 1);
    plane_ = OutlinePlane(corners);
    return cutters_ <= max_cutters && link_segments() &&
           meetings_.find(plane_, segments, cutters_) && sort_stops() &&
           find_containments_at_corner() && walk_outline() && walk_paths();
}

bool FacetOutline::trace_section(const Plane& plane, std::span<const OutlineSegment> segments) {
    segments_ = segments;
    edges_.clear();
    has_projection_ = false;
    exact_ = nullptr;
    cutters_ = 1;
    if (segments.empty() ||
        std::ranges::any_of(segments, [](const OutlineSegment& s) { return s.cutter != 0; }))
        return false;
    plane_ = OutlinePlane(plane, segments[0].at[0]->c);
    bool open = true;
    if (!link_segments() || !meetings_.find(plane_, segments, cutters_) ||
        !has_open_outside(0, open) || open)
        return false;
    walked_.assign(segments.size(), 0);
    for (std::uint32_t s = 0; s < segments.size(); ++s)
        if (walked_[s] == 0 && (next_[s] == none || !walk_path(s, 0))) return false;
    return true;
}

// --- Paths.

// Every end inside the facet is one segment's last and another one's first.
bool FacetOutline::link_segments() {
    constexpr std::size_t few = 12;
    next_.assign(segments_.size(), none);
    starts_.clear();
    std::size_t ends = 0;
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
        const OutlineSegment& segment = segments_[s];
        if (segment.edge[0] < 0) starts_.push_back({segment.through[0], segment.cutter, s, false});
        if (segment.edge[1] < 0) ++ends;
    }
    if (starts_.size() != ends) return false;
    if (sorted_starts_ = ends > few; sorted_starts_)
        std::ranges::sort(starts_, [](const Start& a, const Start& b) {
            return a.is_before(b.through, b.cutter);
        });
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
        const OutlineSegment& segment = segments_[s];
        if (segment.edge[1] >= 0) continue;
        Start* const start = start_at(segment.through[1], segment.cutter);
        if (start == nullptr || start->taken) return false;
        start->taken = true;
        next_[s] = start->segment;
    }
    return true;
}

// Of equal ones always the same, so that it is taken twice.
FacetOutline::Start* FacetOutline::start_at(std::uint64_t through, std::uint32_t cutter) {
    auto at = starts_.begin();
    if (sorted_starts_) {
        at = std::partition_point(starts_.begin(), starts_.end(),
                                  [&](const Start& s) { return s.is_before(through, cutter); });
    } else {
        while (at != starts_.end() && (at->through != through || at->cutter != cutter)) ++at;
    }
    const bool found = at != starts_.end() && at->through == through && at->cutter == cutter;
    return found ? &*at : nullptr;
}

// --- The facet's outline.

// In the order of a walk around it, counter-clockwise seen from above.
bool FacetOutline::sort_stops() {
    for (auto& stops : stops_) stops.clear();
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        for (std::size_t end = 0; end < 2; ++end)
            if (const std::int8_t edge = segments_[s].edge[end]; edge >= 0)
                stops_[static_cast<std::size_t>(edge)].push_back(
                    {0, 0, s, static_cast<std::int8_t>(end)});
    for (std::size_t e = 0; e < 3; ++e)
        if (stops_[e].size() > 1 && !sort_stops_on(e)) return false;
    return true;
}

// Along the axis along which the edge is longest.
bool FacetOutline::sort_stops_on(std::size_t edge) {
    std::size_t axis = 0;
    double way = 0;
    for (int k = 0; k < 3; ++k) {
        const double step =
            (*corners_[(edge + 1) % 3])[k].to_double() - (*corners_[edge])[k].to_double();
        if (k > 0 && std::fabs(step) <= std::fabs(way)) continue;
        axis = static_cast<std::size_t>(k);
        way = step;
    }
    auto& stops = stops_[edge];
    for (Stop& s : stops) {
        const Approximation& at = *segments_[s.segment].at[static_cast<std::size_t>(s.end)];
        s.along = way > 0 ? at.c[axis] : -at.c[axis];
        s.error = at.error;
    }
    const auto is_clear = [](const Stop& a, const Stop& b) {
        return std::fabs(b.along - a.along) > bound_slack * (a.error + b.error);
    };
    if (exact_ == nullptr) {
        std::ranges::sort(stops, {}, &Stop::along);
        for (std::size_t i = 1; i < stops.size(); ++i)
            if (!is_clear(stops[i - 1], stops[i])) return false;
        return true;
    }
    bool known = true;
    std::ranges::sort(stops, [&](const Stop& a, const Stop& b) {
        if (a.segment == b.segment) return false;
        if (is_clear(a, b)) return a.along < b.along;
        const int order = exact_->order_on(edge, a.segment, b.segment);
        known = known && order != 0;
        return order < 0;
    });
    return known;
}

bool FacetOutline::find_containments_at_corner() {
    at_corner_ = 0;
    Containments known = 0;
    for (const auto& stops : stops_)
        for (const Stop& s : stops) {
            const Containments b = bit(s.segment);
            if ((known & b) != 0) continue;
            known |= b;
            if (s.end == 1) at_corner_ |= b;
        }
    for (std::uint32_t c = 0; c < cutters_; ++c) {
        bool open = true;
        if ((known >> c & 1U) == 0 && !has_open_outside(c, open)) return false;
        if (!open) at_corner_ |= Containments{1} << c;
    }
    return true;
}

// Of a cutter with nothing but closed paths.
bool FacetOutline::has_open_outside(std::uint32_t cutter, bool& open) {
    if (!set_projection()) return false;
    double area = 0;
    double error = 0;
    const double u0 = plane_.origin[axis_u_];
    const double v0 = plane_.origin[axis_v_];
    for (const OutlineSegment& s : segments_) {
        if (s.cutter != cutter) continue;
        const Approximation& a = *s.at[0];
        const Approximation& b = *s.at[1];
        const double au = a.c[axis_u_] - u0;
        const double av = a.c[axis_v_] - v0;
        const double bu = b.c[axis_u_] - u0;
        const double bv = b.c[axis_v_] - v0;
        const double p = au * bv;
        const double q = av * bu;
        area += p - q;
        const double e = a.error + b.error;
        const double size = std::fabs(au) + std::fabs(av) + std::fabs(bu) + std::fabs(bv);
        // The sum so far is rounded as well.
        error += 0x1p-49 * (std::fabs(p) + std::fabs(q) + std::fabs(area)) + 2 * e * (size + e);
    }
    if (std::fabs(area) > error || exact_ == nullptr || cutters_ != 1) {
        open = area < 0;
        return std::fabs(area) > error;
    }
    // Paths around nothing, but for the shift.
    open = exact_->first_corner() == Crossings::Corner::Open;
    return exact_->first_corner() != Crossings::Corner::Unknown;
}

// Where no cutter contains it, the outline bounds the open part.
bool FacetOutline::walk_outline() {
    at_stop_.assign(segments_.size(), 0);
    Containments containments = at_corner_;
    OutlinePoint at{};
    for (std::int8_t edge = 0; edge < 3; ++edge) {
        const auto go_to = [&](const OutlinePoint& to) {
            if (containments == 0) edges_.push_back({at, to, edge, 0});
            at = to;
        };
        for (const Stop& s : stops_[static_cast<std::size_t>(edge)]) {
            go_to({OutlinePoint::Kind::End, s.end, s.segment});
            const Containments b = bit(s.segment);
            if (((containments & b) != 0) != (s.end == 1)) return false;
            containments ^= b;
            // A segment across the facet has both ends here: the walk along it compares them.
            if (s.end == 0 || segments_[s.segment].edge[0] < 0)
                at_stop_[s.segment] = containments & ~b;
        }
        go_to({OutlinePoint::Kind::Corner, static_cast<std::int8_t>((edge + 1) % 3), 0});
    }
    return containments == at_corner_;
}

// --- Along the paths.

bool FacetOutline::walk_paths() {
    walked_.assign(segments_.size(), 0);
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        if (segments_[s].edge[0] >= 0 && !walk_path(s, at_stop_[s])) return false;
    return walk_closed_paths();
}

// From paths that were walked as far as meetings lead; then from the last that is left. Only
// segments with meetings are looked at again and again: a facet may have thousands of paths.
bool FacetOutline::walk_closed_paths() {
    meeting_.clear();
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        if (walked_[s] == 0 && !meetings_.of(s).empty()) meeting_.push_back(s);
    std::size_t left = segments_.size();  // all after them are walked
    while (true) {
        bool found = false;
        for (const std::uint32_t s : meeting_) {
            Containments containments = 0;
            if (walked_[s] != 0 || !start_from_meeting(s, containments)) continue;
            if (!walk_path(s, containments)) return false;
            found = true;
        }
        std::erase_if(meeting_, [&](std::uint32_t s) { return walked_[s] != 0; });
        if (found) continue;
        while (left > 0 && walked_[left - 1] != 0) --left;
        if (left == 0) return true;
        const auto last = static_cast<std::uint32_t>(left - 1);
        Containments containments = 0;
        if (!start_from_corner(last, containments) || !walk_path(last, containments)) return false;
    }
}

bool FacetOutline::walk_path(std::uint32_t start, Containments containments) {
    const Containments own = bit(start);
    const Containments at_start = containments;
    if ((containments & own) != 0) return false;
    std::uint32_t s = start;
    while (true) {
        if (walked_[s] != 0) return false;
        walked_[s] = 1;
        OutlinePoint at{OutlinePoint::Kind::End, 0, s};
        const auto go_to = [&](const OutlinePoint& to) {
            if (containments == 0) edges_.push_back({at, to, -1, s});
            at = to;
        };
        for (OutlineMeetings::Meeting& m : meetings_.of(s)) {
            go_to({OutlinePoint::Kind::Meeting, 0, m.point});
            m.before = containments;
            const Containments b = bit(m.other);
            if (((containments & b) != 0) != m.opens) return false;
            containments ^= b;
        }
        go_to({OutlinePoint::Kind::End, 1, s});
        if (next_[s] == none) {
            // A path of one segment has kept its first stop.
            return segments_[s].edge[0] >= 0 || containments == at_stop_[s];
        }
        s = next_[s];
        if (s == start) return containments == at_start;
    }
}

// From a path that was walked and meets this segment; false when there is none.
bool FacetOutline::start_from_meeting(std::uint32_t segment, Containments& containments) {
    const auto meetings = meetings_.of(segment);
    for (std::size_t i = 0; i < meetings.size(); ++i) {
        const OutlineMeetings::Meeting& m = meetings[i];
        if (walked_[m.other] == 0) continue;
        const auto there =
            std::ranges::find(meetings_.of(m.other), m.point, &OutlineMeetings::Meeting::point);
        containments = there->before & ~bit(segment);
        if (m.opens) containments |= bit(m.other);
        // Back to the segment's start.
        for (std::size_t k = i; k > 0; --k) {
            const Containments b = bit(meetings[k - 1].other);
            containments = meetings[k - 1].opens ? containments | b : containments & ~b;
        }
        return true;
    }
    return false;
}

// By a straight way from the facet's first corner, unless there is no other cutter.
bool FacetOutline::start_from_corner(std::uint32_t segment, Containments& containments) {
    if (cutters_ == 1) {
        containments = 0;
        return true;
    }
    if (!set_projection()) return false;
    const Approximation from = approximate(*corners_[0]);
    const Approximation& to = *segments_[segment].at[0];
    containments = at_corner_ & ~bit(segment);
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
        if (segments_[s].cutter == segments_[segment].cutter) continue;
        const Approximation& first = *segments_[s].at[0];
        const Approximation& last = *segments_[s].at[1];
        const int a = turn(from, to, first);
        const int b = turn(from, to, last);
        if (a * b > 0) continue;
        const int c = turn(first, last, from);
        const int d = turn(first, last, to);
        if (c * d > 0) continue;
        if (a == 0 || b == 0 || c == 0 || d == 0) return false;
        containments ^= bit(s);
    }
    return true;
}

// --- In a plane.

bool FacetOutline::set_projection() {
    if (has_projection_) return true;
    const std::size_t k = plane_.dominant_axis();
    if (std::fabs(plane_.normal[k]) <= minor_rounding * plane_.minor[k]) return false;
    axis_u_ = plane_.normal[k] > 0 ? (k + 1) % 3 : (k + 2) % 3;
    axis_v_ = plane_.normal[k] > 0 ? (k + 2) % 3 : (k + 1) % 3;
    has_projection_ = true;
    return true;
}

// 1: to the left; 0 when doubles cannot decide.
int FacetOutline::turn(const Approximation& a, const Approximation& b,
                       const Approximation& c) const {
    return PlaneProjection::filtered_orientation(
        a, b, c, {static_cast<int>(axis_u_), static_cast<int>(axis_v_)});
}

}  // namespace trisect::detail
