// SPDX-License-Identifier: Apache-2.0
//
// The sweep of Shamos and Hoey (1976), which stops at the first contact. Vertices are taken in
// lexicographic order, so a vertical segment is nothing special: it runs upwards in the limit of a
// slightly slanted line. At a vertex the segments that end there go, the vertex is located among
// those that stay (on one of them is a contact), and those that begin there come. Neighbours on the
// line that are new to each other must still be in the same order where the first of them ends.
// Before the leftmost contact all neighbours were in order, so the two that meet there became
// neighbours at some vertex, and were compared.
//
// Winding numbers change by one at a segment: from the bottom to the top of the line a segment that
// runs with the sweep, its region above it, and one that runs against it must alternate.

#include <trisect/brep/face/region_outline.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include <trisect/brep/face/sweep_line.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Index = std::uint32_t;

// Segments between vertices, which are numbered in the order of the sweep.
class Segments {
public:
    Segments(std::span<const LatticePoint> points, FlatAxes axes,
             std::span<const OutlineEdge> edges) {
        std::vector<Index> names;
        names.reserve(edges.size());
        for (const OutlineEdge& e : edges) {
            names.push_back(e.from);
            names.push_back(e.to);
        }
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        std::vector<Index> order(names.size());
        std::iota(order.begin(), order.end(), 0U);
        std::vector<FlatCorner> flat(names.size());
        for (std::size_t i = 0; i < names.size(); ++i)
            flat[i] = flat_corner(points[names[i]], axes.u, axes.v);
        std::sort(order.begin(), order.end(), [&](Index a, Index b) { return flat[a] < flat[b]; });
        places_.reserve(order.size());
        std::vector<Index> rank(order.size());
        for (const Index i : order) {
            rank[i] = static_cast<Index>(places_.size());
            places_.push_back(flat[i]);
        }
        const auto rank_of = [&](Index name) {
            const auto it = std::lower_bound(names.begin(), names.end(), name);
            return rank[static_cast<std::size_t>(it - names.begin())];
        };
        segments_.reserve(edges.size());
        for (const OutlineEdge& e : edges) {
            const Index a = rank_of(e.from);
            const Index b = rank_of(e.to);
            segments_.push_back({std::min(a, b), std::max(a, b), a < b});
        }
        std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
            return a.first != b.first ? a.first < b.first : a.last < b.last;
        });
        by_last_.resize(segments_.size());
        std::iota(by_last_.begin(), by_last_.end(), 0U);
        std::sort(by_last_.begin(), by_last_.end(), [this](Index a, Index b) {
            return segments_[a].last != segments_[b].last ? segments_[a].last < segments_[b].last
                                                          : a < b;
        });
    }

    [[nodiscard]] Index vertex_count() const { return static_cast<Index>(places_.size()); }
    [[nodiscard]] Index size() const { return static_cast<Index>(segments_.size()); }
    [[nodiscard]] bool has_equal_places() const {
        return std::adjacent_find(places_.begin(), places_.end()) != places_.end();
    }
    [[nodiscard]] Index from(Index s) const { return segments_[s].first; }
    [[nodiscard]] Index to(Index s) const { return segments_[s].last; }
    [[nodiscard]] bool runs_with_sweep(Index s) const { return segments_[s].with_sweep; }
    /// Segments in the order in which they end; they are numbered in the order in which they begin.
    [[nodiscard]] Index ending(Index i) const { return by_last_[i]; }
    /// 1 when the vertex is above the segment's line.
    [[nodiscard]] int above(Index s, Index vertex) const {
        return turn(places_[segments_[s].first], places_[segments_[s].last], places_[vertex]);
    }

private:
    struct Segment {
        Index first, last;
        bool with_sweep;
    };
    std::vector<FlatCorner> places_;
    std::vector<Segment> segments_;
    std::vector<Index> by_last_;
};

class Sweep {
public:
    explicit Sweep(const Segments& segments)
        : segments_(segments), line_(Below{&segments}), where_(segments.size()) {}

    [[nodiscard]] bool finds_region() {
        Index next_begin = 0;
        Index next_end = 0;
        for (Index vertex = 0; vertex < segments_.vertex_count(); ++vertex) {
            check_stop();
            for (;
                 next_end < segments_.size() && segments_.to(segments_.ending(next_end)) == vertex;
                 ++next_end)
                line_.erase(where_[segments_.ending(next_end)]);
            const Index begin = next_begin;
            while (next_begin < segments_.size() && segments_.from(next_begin) == vertex)
                ++next_begin;
            if (!pass(vertex, begin, next_begin)) return false;
        }
        return true;
    }

private:
    struct Vertex {
        Index rank;
    };
    struct Below {
        using is_transparent = void;
        const Segments* segments;
        bool operator()(Index a, Index b) const { return lies_below(*segments, a, b); }
        bool operator()(Index a, Vertex v) const { return segments->above(a, v.rank) > 0; }
        bool operator()(Vertex v, Index a) const { return segments->above(a, v.rank) < 0; }
    };
    using Line = std::set<Index, Below>;
    static constexpr Index none = std::numeric_limits<Index>::max();

    // Segments begin, ..., end - 1 begin at the vertex; those that end there are gone.
    bool pass(Index vertex, Index begin, Index end) {
        const auto upper = line_.lower_bound(Vertex{vertex});
        if (upper != line_.end() && segments_.above(*upper, vertex) == 0) return false;
        for (Index s = begin; s < end; ++s) {
            const auto [it, is_new] = line_.insert(s);
            if (!is_new) return false;  // on the line of another one
            where_[s] = it;
        }
        auto at = std::prev(upper, static_cast<std::ptrdiff_t>(end - begin));
        Index below = at == line_.begin() ? none : *std::prev(at);
        for (; at != upper; ++at) {
            if (!are_in_order(below, *at)) return false;
            below = *at;
        }
        return are_in_order(below, upper == line_.end() ? none : *upper);
    }

    // Whether neighbours on the line, or one and nothing, are so until one of them ends or both do
    // in one vertex, and have the region on the right side.
    [[nodiscard]] bool are_in_order(Index low, Index high) const {
        if (low != none && high != none && !stay_apart(low, high)) return false;
        const bool region_above_low = low != none && segments_.runs_with_sweep(low);
        const bool region_below_high = high != none && !segments_.runs_with_sweep(high);
        return region_above_low == region_below_high;
    }
    [[nodiscard]] bool stay_apart(Index low, Index high) const {
        const Index end_low = segments_.to(low);
        const Index end_high = segments_.to(high);
        if (end_low == end_high) return true;
        return end_low < end_high ? segments_.above(high, end_low) < 0
                                  : segments_.above(low, end_high) > 0;
    }

    const Segments& segments_;
    Line line_;
    std::vector<Line::iterator> where_;
};

}  // namespace

bool is_region_outline(std::span<const LatticePoint> points, FlatAxes axes,
                       std::span<const OutlineEdge> edges) {
    const Segments segments(points, axes, edges);
    return !segments.has_equal_places() && Sweep(segments).finds_region();
}

}  // namespace trisect::detail
