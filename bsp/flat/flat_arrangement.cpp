// SPDX-License-Identifier: Apache-2.0
//
// Vertices are numbered as they are found: corners by value, crossings by pairs of segments. Two
// numbers stand for one place where lines of several segments run through one point. Those are
// always on a common segment, so they are found when the vertices on a segment are put in order.

#include <trisect/bsp/flat/flat_arrangement.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

FlatCorner shifted(const FlatCorner& c, int shift) {
    return shift == 0 ? c
                      : FlatCorner{Coordinate(std::ldexp(c.u.to_double(), shift)),
                                   Coordinate(std::ldexp(c.v.to_double(), shift))};
}

}  // namespace

void FlatArrangement::add(const FlatRegion& region, int shift) {
    const auto operand = static_cast<Index>(rules_.size());
    rules_.push_back(region.rule);
    const auto first_line = static_cast<Index>(figure_.lines.size());
    for (const FlatRegion::Line& l : region.lines)
        figure_.lines.push_back({shifted(l.a, shift), shifted(l.b, shift), l.name});
    std::vector<Index> numbers;
    numbers.reserve(region.vertices.size());
    for (const FlatRegion::Vertex& v : region.vertices) {
        if (v.is_corner()) {
            numbers.push_back(figure_.corner(shifted(v.corner(), shift)));
            continue;
        }
        numbers.push_back(static_cast<Index>(figure_.vertices.size()));
        figure_.vertices.push_back({std::ldexp(v.u, shift),
                                    std::ldexp(v.v, shift),
                                    std::ldexp(v.error, shift),
                                    {v.lines[0] + first_line, v.lines[1] + first_line}});
    }
    for (const FlatRegion::Segment& s : region.segments) {
        const Index from = numbers[s.from];
        const Index to = numbers[s.to];
        const Index line = s.line + first_line;
        if (from != to) segments_.push_back({from, to, line, operand, s.along});
    }
}

void FlatArrangement::divide() {
    check_stop(segments_.size());
    cancel_opposite();
    std::vector<FlatBox> boxes;
    boxes.reserve(segments_.size());
    for (const Segment& s : segments_) boxes.push_back(box_of(s));
    boxes_.emplace(boxes);
    same_.resize(figure_.vertices.size());
    for (std::size_t i = 0; i < same_.size(); ++i) same_[i] = static_cast<Index>(i);
    std::size_t looked_at = 0;
    boxes_->for_each_pair([&](Index s, Index t) {
        if (++looked_at % 1024 == 0) check_stop(1024);
        meet(s, t);
    });
    sort_places();
    make_parts();
    make_edges();
}

// Segments of one operand between the same ends, in opposite directions: as where triangles have a
// side in common.
void FlatArrangement::cancel_opposite() {
    std::vector<std::pair<std::uint64_t, Index>> by_ends;
    by_ends.reserve(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const auto [low, high] = std::minmax(segments_[i].from, segments_[i].to);
        by_ends.emplace_back((std::uint64_t{low} << 32U) | high, static_cast<Index>(i));
    }
    std::sort(by_ends.begin(), by_ends.end());
    std::vector<bool> is_dropped(segments_.size(), false);
    bool drops = false;
    for (std::size_t i = 0; i < by_ends.size();) {
        std::size_t end = i + 1;
        while (end < by_ends.size() && by_ends[end].first == by_ends[i].first) ++end;
        for (std::size_t k = i; k < end; ++k)
            for (std::size_t m = k + 1; m < end && !is_dropped[by_ends[k].second]; ++m) {
                const Segment& a = segments_[by_ends[k].second];
                const Segment& b = segments_[by_ends[m].second];
                const bool opposite = a.from == b.to || rules_[a.operand] == FlatRegion::Rule::Odd;
                if (is_dropped[by_ends[m].second] || a.operand != b.operand || !opposite) continue;
                is_dropped[by_ends[k].second] = is_dropped[by_ends[m].second] = drops = true;
            }
        i = end;
    }
    if (!drops) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < segments_.size(); ++i)
        if (!is_dropped[i]) segments_[kept++] = segments_[i];
    segments_.resize(kept);
}

FlatBox FlatArrangement::box_of(const Segment& s) const {
    const FlatRegion::Vertex& p = figure_.vertices[s.from];
    const FlatRegion::Vertex& q = figure_.vertices[s.to];
    // Sums that round down are paid for by a larger error.
    const double e = 2 * std::max(p.error, q.error);
    return {{std::min(p.u, q.u) - e, std::min(p.v, q.v) - e},
            {std::max(p.u, q.u) + e, std::max(p.v, q.v) + e}};
}

void FlatArrangement::join(Index p, Index q) {
    p = place(p);
    q = place(q);
    if (p == q) return;
    // A corner stands for all others.
    const bool keeps_q =
        !figure_.vertices[p].is_corner() && (figure_.vertices[q].is_corner() || q < p);
    if (keeps_q) std::swap(p, q);
    same_[q] = p;
}

void FlatArrangement::put_within(Index segment, Index vertex) { on_.emplace_back(segment, vertex); }

// A vertex on the segment, ends included.
void FlatArrangement::put_on(Index segment, Index vertex) {
    const Segment& s = segments_[segment];
    if (vertex == s.from || vertex == s.to) return;
    const auto [first, last] = ends_along(s);
    const int after_first = figure_.compare_along(s.line, vertex, first);
    if (after_first < 0) return;
    if (after_first == 0) return join(vertex, first);
    const int after_last = figure_.compare_along(s.line, vertex, last);
    if (after_last > 0) return;
    if (after_last == 0) return join(vertex, last);
    put_within(segment, vertex);
}

void FlatArrangement::meet_on_line(Index s, Index t) {
    const Segment a = segments_[s];
    const Segment b = segments_[t];
    for (const Index v : {b.from, b.to}) put_on(s, v);
    for (const Index v : {a.from, a.to}) put_on(t, v);
}

// Whether they have an end in common and nothing else: the other ends are not on one line.
bool FlatArrangement::meet_in_common_end(Index s, Index t) {
    const Segment& a = segments_[s];
    const Segment& b = segments_[t];
    const bool at_from = b.from == a.from || b.from == a.to;
    const bool at_to = b.to == a.from || b.to == a.to;
    return at_from != at_to && figure_.side(a.line, at_from ? b.to : b.from) != 0;
}

void FlatArrangement::meet(Index s, Index t) {
    if (meet_in_common_end(s, t)) return;
    const Segment a = segments_[s];
    const Segment b = segments_[t];
    const int b_from = figure_.side(a.line, b.from);
    const int b_to = figure_.side(a.line, b.to);
    if (b_from * b_to > 0) return;
    if (b_from == 0 && b_to == 0) return meet_on_line(s, t);
    const int a_from = figure_.side(b.line, a.from);
    const int a_to = figure_.side(b.line, a.to);
    if (a_from * a_to > 0) return;
    // Each reaches the other's line, and these are two: so they meet in one point.
    if (b_from * b_to * a_from * a_to != 0) {
        const Index v = figure_.crossing(a.line, b.line);
        while (same_.size() < figure_.vertices.size())
            same_.push_back(static_cast<Index>(same_.size()));
        put_within(s, v);
        put_within(t, v);
        return;
    }
    const Index on_a = b_from == 0 ? b.from : (b_to == 0 ? b.to : none);
    const Index on_b = a_from == 0 ? a.from : (a_to == 0 ? a.to : none);
    if (on_a != none && on_b != none) return join(on_a, on_b);
    if (on_a != none) return put_within(s, on_a);
    put_within(t, on_b);
}

// Vertices within each segment in their order; those at one place are joined.
void FlatArrangement::sort_places() {
    std::sort(on_.begin(), on_.end());
    for (std::size_t i = 0; i < on_.size();) {
        std::size_t end = i + 1;
        while (end < on_.size() && on_[end].first == on_[i].first) ++end;
        const Index line = segments_[on_[i].first].line;
        if (end - i > 1)
            std::sort(on_.begin() + static_cast<std::ptrdiff_t>(i),
                      on_.begin() + static_cast<std::ptrdiff_t>(end),
                      [&](const auto& x, const auto& y) {
                          return figure_.compare_along(line, x.second, y.second) < 0;
                      });
        for (std::size_t k = i + 1; k < end; ++k)
            if (on_[k].second != on_[k - 1].second &&
                figure_.compare_along(line, on_[k].second, on_[k - 1].second) == 0)
                join(on_[k].second, on_[k - 1].second);
        i = end;
    }
    for (Index& v : same_) v = place(v);
}

void FlatArrangement::make_parts() {
    parts_.reserve(segments_.size() + on_.size());
    std::size_t next = 0;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        const auto [first, last] = ends_along(segments_[s]);
        const bool along = segments_[s].along;
        Index at = same_[first];
        const auto go_to = [&](Index vertex) {
            const Index to = same_[vertex];
            if (to == at) return;
            const auto [low, high] = std::minmax(at, to);
            const bool up = (at == low) == along;
            parts_.push_back({(std::uint64_t{low} << 32U) | high, static_cast<Index>(s), up});
            at = to;
        };
        for (; next < on_.size() && on_[next].first == s; ++next) go_to(on_[next].second);
        go_to(last);
    }
    std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
        return a.key != b.key ? a.key < b.key : a.segment < b.segment;
    });
}

void FlatArrangement::make_edges() {
    for (std::size_t i = 0; i < parts_.size();) {
        const auto first = static_cast<Index>(changes_.size());
        const Part& part = parts_[i];
        std::size_t end = i;
        for (; end < parts_.size() && parts_[end].key == part.key; ++end) {
            const Index operand = segments_[parts_[end].segment].operand;
            const int by = parts_[end].forward ? 1 : -1;
            if (changes_.size() > first && changes_.back().operand == operand) {
                changes_.back().by += by;
            } else {
                changes_.push_back({operand, by});
            }
        }
        i = end;
        // Segments of an operand follow each other.
        const auto is_nothing = [&](Change& c) {
            if (rules_[c.operand] == FlatRegion::Rule::Odd) c.by = std::abs(c.by) % 2;
            return c.by == 0;
        };
        changes_.erase(std::remove_if(changes_.begin() + first, changes_.end(), is_nothing),
                       changes_.end());
        if (changes_.size() == first) continue;
        const Segment& s = segments_[part.segment];
        edges_.push_back({static_cast<Index>(part.key >> 32U), static_cast<Index>(part.key), s.line,
                          part.forward == s.along, first, static_cast<Index>(changes_.size())});
    }
}

// The ray goes down from a point that is to the right of the vertex by an infinitesimal. A segment
// counts where its left end is not to the right of the vertex and its right end is.
int FlatArrangement::change_above(Index segment, Index vertex) const {
    const Segment& s = segments_[segment];
    const int from = figure_.compare_u(s.from, vertex);
    const int to = figure_.compare_u(s.to, vertex);
    const bool from_counts = from <= 0;
    const bool to_counts = to <= 0;
    if (from_counts == to_counts) return 0;
    const bool rightwards = from_counts;  // then the left is above
    const int side = figure_.side(s.line, vertex) * (s.along ? 1 : -1);
    const bool is_below = rightwards ? side > 0 : side < 0;
    if (!is_below) return 0;
    return rightwards ? 1 : -1;
}

}  // namespace trisect::detail
