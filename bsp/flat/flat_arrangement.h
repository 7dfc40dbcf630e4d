// SPDX-License-Identifier: Apache-2.0
//
// FlatArrangement: the segments of any number of regions, divided where they meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/flat/flat_region.h>
#include <trisect/bsp/flat/flat_boxes.h>
#include <trisect/bsp/flat/flat_figure.h>

namespace trisect::detail {

/// A plane graph: its edges meet in common vertices only, each lies between two different places,
/// and an edge stands for all segments that run along it. All exact: segments that touch, overlap
/// or cross in one point are what the others are. Mutable, for one thread.
class FlatArrangement {
public:
    using Index = std::uint32_t;
    static constexpr Index none = FlatRegion::none;

    /// A change of an operand's winding number, from the right of an edge to its left.
    struct Change {
        Index operand = 0;
        int by = 0;
    };
    struct Edge {
        Index from = 0;  ///< vertices
        Index to = 0;
        Index line = 0;
        bool along = false;  ///< from the line's first corner towards its second
        Index first = 0;     ///< of its changes
        Index end = 0;
    };

    /// Operands have the numbers in which they come. On the lattice of 2^-shift of the region's
    /// units. \pre coordinates stay exact
    void add(const FlatRegion& region, int shift);
    /// O(n log n + k) for k pairs of segments with boxes that meet.
    void divide();

    [[nodiscard]] const FlatFigure& figure() const { return figure_; }
    [[nodiscard]] std::size_t operand_count() const { return rules_.size(); }
    [[nodiscard]] FlatRegion::Rule rule(Index operand) const { return rules_[operand]; }
    /// Those across which some operand changes.
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    [[nodiscard]] std::span<const Change> changes(const Edge& e) const {
        return std::span(changes_).subspan(e.first, e.end - e.first);
    }
    /// How winding numbers change from far below a vertex to just below it, and to the right by an
    /// infinitesimal: visit(operand, by).
    template <class Visit>
    void for_each_below(Index vertex, const Visit& visit) const {
        const FlatRegion::Vertex& p = figure_.vertices[vertex];
        const FlatBox ray{{p.u - p.error, -infinite}, {p.u + p.error, p.v + p.error}};
        boxes_->for_each_meeting(ray, [&](Index s) {
            if (const int by = change_above(s, vertex); by != 0) visit(segments_[s].operand, by);
        });
    }

private:
    static constexpr double infinite = 1e300;
    struct Segment {
        Index from = 0;
        Index to = 0;
        Index line = 0;
        Index operand = 0;
        bool along = false;
    };
    struct Part {
        std::uint64_t key = 0;  // of its ends, the smaller one first
        Index segment = 0;
        bool forward = false;  // as the segment, from the smaller end
    };

    void cancel_opposite();
    [[nodiscard]] FlatBox box_of(const Segment& s) const;
    void meet(Index s, Index t);
    [[nodiscard]] bool meet_in_common_end(Index s, Index t);
    void meet_on_line(Index s, Index t);
    void put_on(Index segment, Index vertex);
    void put_within(Index segment, Index vertex);
    void sort_places();
    void make_parts();
    void make_edges();
    [[nodiscard]] int change_above(Index segment, Index vertex) const;
    [[nodiscard]] Index place(Index vertex) const {
        while (same_[vertex] != vertex) vertex = same_[vertex];
        return vertex;
    }
    void join(Index p, Index q);
    [[nodiscard]] std::pair<Index, Index> ends_along(const Segment& s) const {
        return s.along ? std::pair(s.from, s.to) : std::pair(s.to, s.from);
    }

    FlatFigure figure_;
    std::vector<FlatRegion::Rule> rules_;
    std::vector<Segment> segments_;
    std::optional<FlatBoxes> boxes_;
    std::vector<Index> same_;                  // by vertex: another one at its place
    std::vector<std::pair<Index, Index>> on_;  // a segment, a vertex within it
    std::vector<Part> parts_;
    std::vector<Edge> edges_;
    std::vector<Change> changes_;
};

}  // namespace trisect::detail
