// SPDX-License-Identifier: Apache-2.0
//
// Links: differences of winding numbers between neighbouring polygons of a leaf.
// No trace is needed for them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// A polygon that gets one answer: item i, when nothing cuts or overlaps it, is node i; piece p is
/// node (number of items) + p. "Above" is in the sense of the item's support.
using LeafNode = LeafIndex;

/// One operand's winding number is larger by `change` at another node.
struct LeafChange {
    LeafIndex operand = 0;
    int change = 0;
};

/// A forest over the nodes of a leaf. Across each of its links the winding numbers above change in
/// a known way, those of an embedded operand above its own facets apart (they need no link).
///
/// Two nodes may be linked when they have an open part of an edge in common, in the cell:
///  - across an edge of their mesh, when no other surface contains part of it: nothing changes. An
///    operand that may meet itself must have exactly two facets there, or they are separate;
///  - across a line within one facet, when every other polygon that contains part of it contains
///    it in its interior: crossing such a polygon takes its step. If that polygon's operand is
///    embedded, the winding numbers on both sides are even known: 0 outside and 1 inside.
/// Contact is decided exactly. Whether two edges overlap is decided in doubles with a margin: a
/// contact may be missed, never invented, and a missing link costs a trace.
class LeafLinks {
public:
    /// \pre the contacts are known and the pieces made.
    void build(LeafWork& work);

    struct Link {
        LeafNode to = -1;
        LeafIndex next = -1;
        std::uint32_t first_change = 0;
        std::uint32_t change_count = 0;
        int sign = 1;  ///< of the changes
    };
    /// A winding number that is known at a node, above and below it.
    struct Known {
        LeafIndex operand = 0;
        int winding = 0;
        LeafIndex next = -1;
    };
    /// The root of a node's tree; the same for all nodes of the tree.
    [[nodiscard]] LeafNode tree_of(LeafNode node);
    [[nodiscard]] LeafIndex first_link(LeafNode node) const { return first_link_[as_index(node)]; }
    [[nodiscard]] const Link& link(LeafIndex i) const { return links_[as_index(i)]; }
    [[nodiscard]] std::span<const LeafChange> changes(const Link& l) const {
        return {changes_.data() + l.first_change, l.change_count};
    }
    [[nodiscard]] LeafIndex first_known(LeafNode node) const {
        return first_known_[as_index(node)];
    }
    [[nodiscard]] bool any_known() const { return !known_.empty(); }
    [[nodiscard]] const Known& known(LeafIndex i) const { return known_[as_index(i)]; }

private:
    /// Edge k of a node, in the list of those on its line.
    struct Edge {
        LeafNode node = -1;
        std::int32_t k = 0;
        LeafIndex next = -1;
    };
    /// Edges on one line: an edge of a mesh, or a plane across one facet.
    struct Line {
        LeafIndex first = -1;
        bool within_facet = false;
        /// Of an edge of a mesh: the facets at it, up to two; more are counted only.
        std::array<std::uint32_t, 2> facets{};
        std::uint8_t facet_count = 0;
    };
    struct Ends {
        Approximation a;
        Approximation b;
    };
    void add_node(LeafNode node);
    void add_edge(LeafNode node, int k, const PlaneName& plane);
    void add_to_line(const Key128& key, bool within_facet, LeafNode node, int k);
    void count_at_edges(const LeafPiece& piece);
    static void count_facet(Line& line, std::uint32_t facet);
    [[nodiscard]] Line& line_at(const Key128& key, bool within_facet);
    [[nodiscard]] static Key128 key_of_edge(const LeafItem& item, const PlaneName& edge);
    void link_line(const Line& line);
    void try_within_facet(const Edge& a, const Edge& b);
    void try_across_edge(const Edge& a, const Edge& b);

    [[nodiscard]] const LeafItem& item_of(LeafNode node) const;
    [[nodiscard]] LeafIndex item_index(LeafNode node) const;
    [[nodiscard]] const WorkPolygon& shape_of(LeafNode node);
    [[nodiscard]] PlaneName plane_name(const Edge& e);
    [[nodiscard]] Ends ends_of(const Edge& e);
    [[nodiscard]] bool overlap(const Edge& a, const Edge& b);
    [[nodiscard]] bool touched_along(const Edge& e);
    [[nodiscard]] bool crossings_of(const Edge& e);
    [[nodiscard]] int side_of_node(LeafNode node, PlaneId plane);
    void note_known(LeafNode node, const LeafItem& crossed, int side);
    void join(LeafNode a, LeafNode b, std::span<const LeafChange> changes);

    LeafWork* work_ = nullptr;
    LeafNode items_ = 0;
    std::vector<LeafNode> parent_;
    std::vector<LeafIndex> first_link_;
    std::vector<Link> links_;
    std::vector<LeafChange> changes_;
    std::vector<LeafIndex> first_known_;
    std::vector<Known> known_;
    FlatMap line_ids_;
    std::vector<Line> lines_;
    std::vector<Edge> edges_;
    std::vector<LeafIndex> crossed_;  // scratch of crossings_of
    std::vector<LeafChange> crossing_changes_;
};

}  // namespace trisect::detail
