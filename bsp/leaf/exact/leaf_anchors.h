// SPDX-License-Identifier: Apache-2.0
//
// Anchors: vertices of a leaf with certain winding numbers of all other operands.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/leaf/exact/leaf_windings.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// One of a polygon's vertices, in the cell and on no other operand's surface.
struct LeafAnchor {
    LeafIndex windings = -1;  ///< see LeafAnchors::windings(); -1 when there is no anchor
    std::size_t corner = 0;   ///< of the polygon
};

/// Winding numbers of the other operands are the same all over a polygon that nothing touches. So
/// vertices in the cell, and edges that run through it, hang together by untouched polygons, and
/// one trace to any vertex serves all that hang together with it; also the cut polygons around
/// them. For leaves of embedded operands: at a vertex of a surface that may meet itself its own
/// winding number would not be known. Scratch memory that is kept from leaf to leaf.
class LeafAnchors {
public:
    /// \pre contacts are known. `windings` was started.
    void build(LeafWork& work, LeafWindings& windings);
    [[nodiscard]] LeafAnchor anchor_of(LeafIndex item);
    /// Takes what was found out about an untouched polygon without an anchor, for its neighbours.
    void remember(LeafIndex item, const std::vector<int>& windings);
    /// By operand; the entry of the polygon's own is meaningless.
    [[nodiscard]] const std::vector<int>& windings(LeafIndex i) const {
        return known_[as_index(i)];
    }

private:
    enum class State : std::uint8_t { Unknown, Known, Useless };
    struct Vertex {
        LeafIndex item = -1;      // where it was seen first, and which corner it is there
        std::int32_t corner = 0;  // -1: an edge
        LeafIndex parent = 0;     // of the union-find forest
        LeafIndex example = -1;   // another vertex of the same tree; of a root
        LeafIndex windings = -1;  // of a root that is known
        State state = State::Unknown;
    };
    // Vertices of an item by corner: -1 not looked up, -2 not in the cell.
    [[nodiscard]] LeafIndex vertex_of(LeafIndex item, std::size_t corner);
    [[nodiscard]] LeafIndex edge_of(LeafIndex item, int edge);
    [[nodiscard]] bool is_in_cell(LeafIndex item, std::size_t corner);
    void join_item(LeafIndex item, LeafIndex vertex);
    [[nodiscard]] std::size_t corner_count(LeafIndex item);
    LeafIndex root(LeafIndex v);
    void join(LeafIndex a, LeafIndex b);
    void find_windings(LeafIndex root);
    [[nodiscard]] bool trace_to(const Vertex& v, std::vector<int>& w);

    LeafWork* work_ = nullptr;
    LeafWindings* windings_ = nullptr;
    FlatMap ids_;
    std::vector<LeafIndex> vertex_of_id_;
    std::vector<Vertex> vertices_;
    std::vector<LeafIndex> first_;  // a vertex of an item, -1 none
    std::vector<std::vector<int>> known_;
    std::size_t known_count_ = 0;
};

}  // namespace trisect::detail
