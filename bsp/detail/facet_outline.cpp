// SPDX-License-Identifier: Apache-2.0
//
// Boundaries in general position cross in closed polylines. On a facet they leave paths of
// segments, from one point of its outline to another or closed, and only there the winding number
// of an operand changes. Segments of one operand hang together by name, at the edges that pierce
// the facet; those of two operands meet inside of both where each has its ends on both sides of the
// other one's plane.
//
// So one walk around the facet's outline knows at every point which cutters cover it: a cutter of
// which a segment ends there has covered one side and leaves the other one open, whatever it does
// elsewhere. From the outline it goes on along the paths, where a cutter changes at its meetings.
// What is covered by none bounds the open part. No winding number is ever traced, and no point is
// made that is not a vertex, but for meetings under a third cutter.
//
// Closed paths know what covers them from a path that they meet, or else by a straight way from a
// corner. Whether a cutter with nothing but closed paths covers the facet around them is told by
// the sign of the area that they enclose, since outermost paths enclose all others.
//
// Everything is asked in doubles with a bound. What has no sure answer ends the attempt.
//
// Meetings are found pair by pair. QuickCSG (Douze, Franco, Raffin 2017) starts from the same
// vertices, but asks for each of them where it lies; walking from one to the next asks nothing.

#include <trisect/bsp/detail/facet_outline.h>

#include <algorithm>
#include <cmath>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/detail/plain_facets.h>

namespace trisect::detail {

namespace {

constexpr double slack = 1.0001;

// The axis along which a way is longest.
std::size_t longest_axis(const std::array<double, 3>& way) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(way[k]) > std::fabs(way[axis])) axis = k;
    return axis;
}

std::array<double, 3> way_between(const Approximation& a, const Approximation& b) {
    return {b.c[0] - a.c[0], b.c[1] - a.c[1], b.c[2] - a.c[2]};
}

// Whether no point of one segment is near one of the other.
bool are_apart(const OutlineSegment& a, const OutlineSegment& b) {
    const double error =
        slack * (std::max(a.at[0].error, a.at[1].error) + std::max(b.at[0].error, b.at[1].error));
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [lo, hi] = std::minmax(a.at[0].c[k], a.at[1].c[k]);
        if ((b.at[0].c[k] > hi + error && b.at[1].c[k] > hi + error) ||
            (b.at[0].c[k] < lo - error && b.at[1].c[k] < lo - error))
            return true;
    }
    return false;
}

}  // namespace

bool FacetOutline::trace(const std::array<const LatticePoint*, 3>& corners,
                         std::span<const OutlineSegment> segments) {
    corners_ = corners;
    segments_ = segments;
    edges_.clear();
    has_projection_ = false;
    cutters_ = 0;
    for (const OutlineSegment& s : segments)
        cutters_ = std::max(cutters_, std::size_t{s.cutter} + 1);
    return cutters_ <= max_cutters && link_segments() && find_meetings() && sort_stops() &&
           find_covers_at_corner() && walk_outline() && walk_paths();
}

// --- Paths.

// Every end inside the facet is one segment's last and another one's first.
bool FacetOutline::link_segments() {
    next_.assign(segments_.size(), none);
    links_.clear();
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        for (std::size_t end = 0; end < 2; ++end)
            if (segments_[s].edge[end] < 0)
                links_.push_back({segments_[s].cutter, segments_[s].through[end], s, end == 0});
    if (links_.size() % 2 != 0) return false;
    std::ranges::sort(links_);
    for (std::size_t i = 0; i < links_.size(); i += 2) {
        const Link& a = links_[i];
        const Link& b = links_[i + 1];
        if (a.cutter != b.cutter || a.through != b.through || a.starts == b.starts) return false;
        if (i + 2 < links_.size() && links_[i + 2].cutter == a.cutter &&
            links_[i + 2].through == a.through)
            return false;
        next_[a.starts ? b.segment : a.segment] = a.starts ? a.segment : b.segment;
    }
    return true;
}

// --- Planes in doubles. For the bounds see plain_facets.cpp.

FacetOutline::Normal FacetOutline::normal_of(const std::array<const LatticePoint*, 3>& corners) {
    Normal out;
    out.made = true;
    Vector3 v{};
    Vector3 w{};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        out.origin[i] = static_cast<double>((*corners[0])[k]);
        v[i] = static_cast<double>((*corners[1])[k] - (*corners[0])[k]);
        w[i] = static_cast<double>((*corners[2])[k] - (*corners[0])[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double s = v[(k + 1) % 3] * w[(k + 2) % 3];
        const double t = v[(k + 2) % 3] * w[(k + 1) % 3];
        out.n[k] = s - t;
        out.minor[k] = std::fabs(s) + std::fabs(t);
    }
    return out;
}

const FacetOutline::Normal& FacetOutline::normal_of(std::uint32_t segment) {
    Normal& plane = normals_[segment];
    if (!plane.made) plane = normal_of(segments_[segment].corners);
    return plane;
}

double FacetOutline::value(const Normal& plane, const Approximation& p, double& error) {
    double sum = 0;
    double permanent = 0;
    double slope = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = p.c[k] - plane.origin[k];
        sum += plane.n[k] * d;
        permanent += plane.minor[k] * std::fabs(d);
        slope += plane.minor[k];
    }
    error = 0x1p-50 * permanent + slack * slope * p.error;
    return sum;
}

// --- Meetings.

bool FacetOutline::find_meetings() {
    meetings_.clear();
    first_meeting_.assign(segments_.size() + 1, 0);
    if (cutters_ > 1) {
        normals_.assign(segments_.size(), {});
        for (std::uint32_t a = 0; a < segments_.size(); ++a)
            for (std::uint32_t b = a + 1; b < segments_.size(); ++b)
                if (segments_[a].cutter != segments_[b].cutter && !meet(a, b)) return false;
    }
    return sort_meetings();
}

// False when it is doubtful whether two segments cross.
bool FacetOutline::meet(std::uint32_t a, std::uint32_t b) {
    if (are_apart(segments_[a], segments_[b])) return true;
    std::array<std::array<double, 2>, 2> values{};
    std::array<double, 2> errors{};
    bool sure = true;
    for (std::size_t i = 0; i < 2; ++i) {
        const OutlineSegment& s = segments_[i == 0 ? a : b];
        const Normal& plane = normal_of(i == 0 ? b : a);
        bool known = true;
        for (std::size_t end = 0; end < 2; ++end) {
            double error = 0;
            values[i][end] = value(plane, s.at[end], error);
            known = known && std::fabs(values[i][end]) > error;
            errors[i] += error;
        }
        if (known && (values[i][0] > 0) == (values[i][1] > 0)) return true;
        sure = sure && known;
    }
    return sure && add_meeting(a, b, values[0], errors[0]) &&
           add_meeting(b, a, values[1], errors[1]);
}

bool FacetOutline::add_meeting(std::uint32_t segment, std::uint32_t other,
                               const std::array<double, 2>& values, double error) {
    const OutlineSegment& s = segments_[segment];
    Meeting& m = meetings_.emplace_back();
    m.segment = segment;
    m.other = other;
    m.opens = (values[1] < 0) == segments_[other].open_below;
    if (!interpolate(s.at[0], values[0], s.at[1], values[1], error, m.at)) return false;
    const std::array<double, 3> way = way_between(s.at[0], s.at[1]);
    const std::size_t axis = longest_axis(way);
    m.along = way[axis] > 0 ? m.at.c[axis] : -m.at.c[axis];
    m.error = m.at.error;
    return true;
}

// Those of one segment in their order along it; false when it is doubtful.
bool FacetOutline::sort_meetings() {
    if (meetings_.empty()) return true;
    std::ranges::sort(meetings_, [](const Meeting& a, const Meeting& b) {
        return a.segment != b.segment ? a.segment < b.segment : a.along < b.along;
    });
    for (std::size_t i = 1; i < meetings_.size(); ++i) {
        const Meeting& a = meetings_[i - 1];
        const Meeting& b = meetings_[i];
        if (a.segment == b.segment && !(b.along - a.along > slack * (a.error + b.error)))
            return false;
    }
    for (const Meeting& m : meetings_) ++first_meeting_[m.segment + 1];
    for (std::size_t s = 1; s < first_meeting_.size(); ++s)
        first_meeting_[s] += first_meeting_[s - 1];
    return true;
}

// --- The facet's outline.

// In the order of a walk around it, counter-clockwise seen from above.
bool FacetOutline::sort_stops() {
    stops_.clear();
    std::array<std::size_t, 3> axis{};
    std::array<double, 3> sign{};
    for (std::size_t e = 0; e < 3; ++e) {
        std::array<double, 3> way{};
        for (int k = 0; k < 3; ++k)
            way[static_cast<std::size_t>(k)] =
                static_cast<double>((*corners_[(e + 1) % 3])[k] - (*corners_[e])[k]);
        axis[e] = longest_axis(way);
        sign[e] = way[axis[e]] > 0 ? 1 : -1;
    }
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        for (std::size_t end = 0; end < 2; ++end) {
            const std::int8_t edge = segments_[s].edge[end];
            if (edge < 0) continue;
            const auto e = static_cast<std::size_t>(edge);
            const Approximation& at = segments_[s].at[end];
            stops_.push_back(
                {edge, static_cast<std::int8_t>(end), s, sign[e] * at.c[axis[e]], at.error});
        }
    std::ranges::sort(stops_, [](const Stop& a, const Stop& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.along < b.along;
    });
    for (std::size_t i = 1; i < stops_.size(); ++i) {
        const Stop& a = stops_[i - 1];
        const Stop& b = stops_[i];
        if (a.edge == b.edge && !(b.along - a.along > slack * (a.error + b.error))) return false;
    }
    return true;
}

bool FacetOutline::find_covers_at_corner() {
    at_corner_ = 0;
    Covers known = 0;
    for (const Stop& s : stops_) {
        const Covers b = bit(s.segment);
        if ((known & b) != 0) continue;
        known |= b;
        if (s.end == 1) at_corner_ |= b;
    }
    for (std::uint32_t c = 0; c < cutters_; ++c) {
        bool open = true;
        if ((known >> c & 1U) == 0 && !has_open_outside(c, open)) return false;
        if (!open) at_corner_ |= Covers{1} << c;
    }
    return true;
}

// Of a cutter with nothing but closed paths.
bool FacetOutline::has_open_outside(std::uint32_t cutter, bool& open) {
    if (!set_projection()) return false;
    double area = 0;
    double error = 0;
    const double u0 = static_cast<double>((*corners_[0])[static_cast<int>(axis_u_)]);
    const double v0 = static_cast<double>((*corners_[0])[static_cast<int>(axis_v_)]);
    for (const OutlineSegment& s : segments_) {
        if (s.cutter != cutter) continue;
        const double au = s.at[0].c[axis_u_] - u0;
        const double av = s.at[0].c[axis_v_] - v0;
        const double bu = s.at[1].c[axis_u_] - u0;
        const double bv = s.at[1].c[axis_v_] - v0;
        const double p = au * bv;
        const double q = av * bu;
        area += p - q;
        const double e = s.at[0].error + s.at[1].error;
        const double size = std::fabs(au) + std::fabs(av) + std::fabs(bu) + std::fabs(bv);
        // The sum so far is rounded as well.
        error += 0x1p-49 * (std::fabs(p) + std::fabs(q) + std::fabs(area)) + 2 * e * (size + e);
    }
    open = area < 0;
    return std::fabs(area) > error;
}

// Where no cutter covers it, the outline bounds the open part.
bool FacetOutline::walk_outline() {
    at_stop_.assign(segments_.size(), 0);
    Covers covers = at_corner_;
    OutlinePoint at{};
    std::int8_t edge = 0;
    const auto go_to = [&](const OutlinePoint& to) {
        if (covers == 0) add_edge(at, to, edge, 0);
        at = to;
    };
    const auto turn_corner = [&] {
        go_to({OutlinePoint::Kind::Corner, static_cast<std::int8_t>((edge + 1) % 3), 0, 0, {}});
        ++edge;
    };
    for (const Stop& s : stops_) {
        while (edge < s.edge) turn_corner();
        go_to({OutlinePoint::Kind::End, s.end, s.segment, 0, {}});
        const Covers b = bit(s.segment);
        if (((covers & b) != 0) != (s.end == 1)) return false;
        covers ^= b;
        const Covers others = covers & ~b;
        // A segment across the facet has both ends here: the walk along it compares them.
        if (s.end == 0 || segments_[s.segment].edge[0] < 0) at_stop_[s.segment] = others;
    }
    while (edge < 3) turn_corner();
    return covers == at_corner_;
}

// --- Along the paths.

bool FacetOutline::walk_paths() {
    walked_.assign(segments_.size(), 0);
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
        if (segments_[s].edge[0] >= 0 && !walk_path(s, at_stop_[s])) return false;
    // Closed ones.
    while (true) {
        std::uint32_t left = none;
        bool found = false;
        for (std::uint32_t s = 0; s < segments_.size(); ++s) {
            if (walked_[s] != 0) continue;
            left = s;
            Covers covers = 0;
            if (!start_from_meeting(s, covers)) continue;
            if (!walk_path(s, covers)) return false;
            found = true;
        }
        if (left == none) return true;
        if (found) continue;
        Covers covers = 0;
        if (!start_from_corner(left, covers) || !walk_path(left, covers)) return false;
    }
}

bool FacetOutline::walk_path(std::uint32_t start, Covers covers) {
    const Covers own = bit(start);
    const Covers at_start = covers;
    if ((covers & own) != 0) return false;
    std::uint32_t s = start;
    while (true) {
        if (walked_[s] != 0) return false;
        walked_[s] = 1;
        OutlinePoint at{OutlinePoint::Kind::End, 0, s, 0, {}};
        const auto go_to = [&](const OutlinePoint& to) {
            if (covers == 0) add_edge(at, to, -1, s);
            at = to;
        };
        for (Meeting& m : meetings_of(s)) {
            go_to({OutlinePoint::Kind::Meeting, 0, s, m.other, m.at});
            m.before = covers;
            const Covers b = bit(m.other);
            if (((covers & b) != 0) != m.opens) return false;
            covers ^= b;
        }
        go_to({OutlinePoint::Kind::End, 1, s, 0, {}});
        if (next_[s] == none) {
            // A path of one segment has kept its first stop.
            return segments_[s].edge[0] >= 0 || covers == at_stop_[s];
        }
        s = next_[s];
        if (s == start) return covers == at_start;
    }
}

// From a path that was walked and meets this segment; false when there is none.
bool FacetOutline::start_from_meeting(std::uint32_t segment, Covers& covers) const {
    const std::size_t first = first_meeting_[segment];
    for (std::size_t i = first; i < first_meeting_[segment + 1]; ++i) {
        const Meeting& m = meetings_[i];
        if (walked_[m.other] == 0) continue;
        std::size_t there = first_meeting_[m.other];
        while (meetings_[there].other != segment) ++there;
        covers = meetings_[there].before & ~bit(segment);
        if (m.opens) covers |= bit(m.other);
        // Back to the segment's start.
        for (std::size_t k = i; k > first; --k) {
            const Covers b = bit(meetings_[k - 1].other);
            covers = meetings_[k - 1].opens ? covers | b : covers & ~b;
        }
        return true;
    }
    return false;
}

// By a straight way from the facet's first corner.
bool FacetOutline::start_from_corner(std::uint32_t segment, Covers& covers) {
    if (!set_projection()) return false;
    const Approximation from = approximate(*corners_[0]);
    const Approximation& to = segments_[segment].at[0];
    covers = at_corner_ & ~bit(segment);
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
        if (segments_[s].cutter == segments_[segment].cutter) continue;
        const auto& at = segments_[s].at;
        const int a = turn(from, to, at[0]);
        const int b = turn(from, to, at[1]);
        if (a * b > 0) continue;
        const int c = turn(at[0], at[1], from);
        const int d = turn(at[0], at[1], to);
        if (c * d > 0) continue;
        if (a == 0 || b == 0 || c == 0 || d == 0) return false;
        covers ^= bit(s);
    }
    return true;
}

// --- In a plane.

bool FacetOutline::set_projection() {
    if (has_projection_) return true;
    const Normal own = normal_of(corners_);
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(own.n[i]) > std::fabs(own.n[k])) k = i;
    if (std::fabs(own.n[k]) <= 0x1p-50 * own.minor[k]) return false;
    axis_u_ = own.n[k] > 0 ? (k + 1) % 3 : (k + 2) % 3;
    axis_v_ = own.n[k] > 0 ? (k + 2) % 3 : (k + 1) % 3;
    has_projection_ = true;
    return true;
}

// 1: to the left; 0 when doubles cannot tell.
int FacetOutline::turn(const Approximation& a, const Approximation& b,
                       const Approximation& c) const {
    return PlaneProjection::filtered_orientation(
        a, b, c, {static_cast<int>(axis_u_), static_cast<int>(axis_v_)});
}

}  // namespace trisect::detail
