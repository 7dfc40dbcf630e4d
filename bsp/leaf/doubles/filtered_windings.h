// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers in leaves in general position (filtered_leaf.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/box_rows.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// Winding numbers of the other operands are the same all over a facet that nothing crosses. So
/// vertices in the cell, and edges that run through it, hang together by such facets, and one trace
/// to any vertex serves all that hang together with it; also the facets that are crossed. Along an
/// edge of these they change where it pierces others, which is known by then: so one trace serves
/// what hangs together by edges as well. The same idea as in leaf_anchors.h, on doubles. Facets
/// beside the box of the only other operand are not even looked at, and where boxes of facets meet
/// in which it has none, one of them determines the others: EvaluateCounters::linked counts both.
class FilteredWindings {
public:
    /// A vertex in the cell where the winding numbers of all other operands are known.
    struct Anchor {
        LeafIndex windings = -1;  ///< see windings(); -1 when there is none
        int corner = 0;           ///< of the item's outline
    };

    void start(FilteredFacets& facets, const FilteredPairs& pairs);
    [[nodiscard]] Anchor anchor_of(LeafIndex item, EvaluateStats& stats);
    /// The windings() of a facet with a part in the cell whose box has no facet of the only other
    /// operand and meets another such box; -1 when there is none.
    [[nodiscard]] LeafIndex from_clear_boxes(LeafIndex item, EvaluateStats& stats);
    /// What was found out about a facet that nothing crosses and that had no anchor, for its
    /// neighbours.
    LeafIndex remember(LeafIndex item, std::span<const int> windings);
    /// By operand; the entry of the facet's own is meaningless.
    [[nodiscard]] std::span<const int> windings(LeafIndex i) const {
        return {known_.data() + as_index(i) * operands_, operands_};
    }
    /// Winding numbers at a point on a facet of the operand `own`, with a meaningless one for that.
    /// The way there starts at the nearest point on that operand where they are known by now, or at
    /// the cell's reference. False when doubles cannot decide.
    [[nodiscard]] bool at_point(const Approximation& target, LeafIndex own, EvaluateStats& stats,
                                std::vector<int>& w);

private:
    enum class State : std::uint8_t { Unknown, Known, Useless };
    /// A vertex in the cell, or an edge through it: a node of a union-find forest.
    struct Node {
        LeafIndex parent = 0;
        LeafIndex item = 0;      // where it was seen first, and which corner it is there
        std::int8_t corner = 0;  // -1: an edge
        State state = State::Unknown;
        LeafIndex example = -1;   // another vertex of the same tree; of a root
        LeafIndex windings = -1;  // of a root that is known
        std::int8_t region = -1;  // of some vertex of the tree; of a root
    };
    /// An edge in the cell, seen from one of its ends.
    struct Way {
        LeafIndex from = 0;  // roots
        LeafIndex to = 0;
        LeafIndex item = 0;
        std::int8_t edge = 0;    // of the item
        std::int8_t corner = 0;  // of the item, where the way starts
    };
    /// Where a trace may start.
    struct Start {
        Approximation at;
        LeafIndex own = -1;       ///< on a facet of this operand; -1: on none
        LeafIndex windings = -1;  ///< of the others
    };
    /// What the box of an item without facets of the only other operand has within the cell.
    struct ClearBox {
        Vector3 lo;
        Vector3 hi;
        LeafIndex windings = -1;
    };
    [[nodiscard]] const Start& nearest_start(const Approximation& target, LeafIndex own) const;
    [[nodiscard]] bool trace(const Start& start, const Approximation& target, LeafIndex own,
                             std::vector<int>& w);
    [[nodiscard]] int region_of(LeafIndex item) const;
    [[nodiscard]] int region_beside(LeafIndex operand, const Vector3& low,
                                    const Vector3& high) const;
    [[nodiscard]] LeafIndex windings_in(int region);
    [[nodiscard]] bool is_clear(LeafIndex item) const {
        return operands_ == 2 && !pairs_->has_partner(item);
    }
    [[nodiscard]] ClearBox clear_box(LeafIndex item, LeafIndex windings) const;
    void list_ways();
    void spread(LeafIndex root);
    [[nodiscard]] bool follow(const Way& way, std::span<int> w) const;
    [[nodiscard]] LeafIndex node_of(const StampMap::Key& key, LeafIndex item, int corner);
    void add_corners(LeafIndex item, bool free);
    void add_edges(LeafIndex item);
    void join_item(LeafIndex item, LeafIndex node);
    [[nodiscard]] LeafIndex root(LeafIndex v);
    void join(LeafIndex a, LeafIndex b);
    void find_windings(LeafIndex root, EvaluateStats& stats);
    LeafIndex keep(std::span<const int> windings);
    [[nodiscard]] const BoxRows& boxes_of(std::size_t operand);
    [[nodiscard]] bool add_crossing(LeafIndex item, const Approximation& start,
                                    const Approximation& target, const Vector3& lo,
                                    const Vector3& hi, std::vector<int>& w);

    FilteredFacets* facets_ = nullptr;
    const FilteredPairs* pairs_ = nullptr;
    std::size_t operands_ = 0;
    std::vector<Start> starts_;  // the reference, and where traces have ended
    StampMap ids_;
    std::vector<Node> nodes_;
    // Nodes of the corners of an item's whole facet; -1 not in the cell, or not in the outline.
    std::vector<std::array<LeafIndex, 3>> vertices_;
    std::vector<LeafIndex> first_;  // a node of an item, -1 none
    // Parts of the cell beside the box of the only other operand: 6 · operand + 2 · axis, 1 more
    // above it; -1 elsewhere.
    std::vector<std::int8_t> regions_of_;
    std::array<LeafIndex, 12> regions_{};  // windings there, -1 unknown
    std::vector<ClearBox> clear_boxes_;
    std::vector<int> known_;  // a row of `operands_` for each
    std::vector<int> traced_;
    std::vector<Way> found_;              // along edges of facets that are crossed
    std::vector<Way> ways_;               // the same, by `from`
    std::vector<std::size_t> first_way_;  // by node
    bool has_ways_ = false;
    std::vector<LeafIndex> reached_;
    // Of all facets of an operand, by operand; made for the first trace that needs them.
    struct OperandBoxes {
        LeafIndex first = 0;
        LeafIndex last = 0;
        bool made = false;
        BoxRows rows;
    };
    std::vector<OperandBoxes> boxes_;
};

}  // namespace trisect::detail
