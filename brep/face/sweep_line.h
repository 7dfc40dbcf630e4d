// SPDX-License-Identifier: Apache-2.0
//
// SweepLine: the regions met by a moving vertical line, from bottom to top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

/// Whether edge a lies below edge b where a vertical line meets both; `figure` as in SweepLine. The
/// one that begins first is compared with the beginning of the other.
template <class Figure>
[[nodiscard]] bool lies_below(const Figure& figure, std::uint32_t a, std::uint32_t b) {
    if (figure.from(a) == figure.from(b)) return figure.above(a, figure.to(b)) > 0;
    return figure.from(a) < figure.from(b) ? figure.above(a, figure.from(b)) > 0
                                           : figure.above(b, figure.from(a)) < 0;
}

/// A figure's edges do not cross; a region of it lies to the left of each. Only edges that run with
/// the sweep are kept: the region is above them, and they stand for it.
///
/// Vertices are given by their rank in the order of the sweep. `Figure` answers
/// `from(edge)` and `to(edge)`, ranks with from < to, and `above(edge, vertex)`, 1 when the vertex
/// lies above the edge's line, exactly. All operations take O(log n) such signs. Before an edge is
/// opened or advanced to, the edges that end at its first vertex must be gone; the order in which
/// edges at one vertex come and go is free otherwise. \throw InternalError for edges that overlap
/// and for edges that end twice; those that cross make answers worthless, and nothing worse.
template <class Figure>
class SweepLine {
public:
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();

    explicit SweepLine(const Figure& figure) : figure_(figure), line_(Below{this}) {}
    SweepLine(const SweepLine&) = delete;
    SweepLine& operator=(const SweepLine&) = delete;

    /// A new region, by a number that grows.
    Index open(Index edge) {
        const auto region = static_cast<Index>(edge_.size());
        edge_.push_back(edge);
        const auto [where, is_new] = line_.insert(region);
        TRISECT_EXPECTS(is_new, "edges that do not overlap");
        where_.push_back(where);
        return region;
    }
    /// The region's lower edge ends and `edge` goes on.
    void advance(Index region, Index edge) { edge_[region] = edge; }
    void close(Index region) {
        TRISECT_EXPECTS(region < where_.size() && where_[region] != line_.end(),
                        "an edge that ends once");
        line_.erase(where_[region]);
        where_[region] = line_.end();
    }
    [[nodiscard]] Index edge(Index region) const { return edge_[region]; }

    /// The region of the highest edge that is strictly below a vertex, or none.
    [[nodiscard]] Index below(Index vertex) const {
        const auto it = line_.lower_bound(Vertex{vertex});
        return it == line_.begin() ? none : *std::prev(it);
    }

private:
    struct Vertex {
        Index rank;
    };
    struct Below {
        using is_transparent = void;
        const SweepLine* line;
        bool operator()(Index a, Index b) const {
            return lies_below(line->figure_, line->edge_[a], line->edge_[b]);
        }
        bool operator()(Index a, Vertex v) const {
            return line->figure_.above(line->edge_[a], v.rank) > 0;
        }
        bool operator()(Vertex v, Index a) const {
            return line->figure_.above(line->edge_[a], v.rank) < 0;
        }
    };
    using Line = std::set<Index, Below>;

    const Figure& figure_;
    Line line_;
    std::vector<Index> edge_;  // by region
    std::vector<typename Line::iterator> where_;
};

}  // namespace trisect::detail
