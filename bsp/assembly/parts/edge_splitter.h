// SPDX-License-Identifier: Apache-2.0
//
// EdgeSplitter: insertion of vertices that lie inside edges (T-vertices).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/bsp/assembly/parts/vertex_boxes.h>
#include <trisect/bsp/assembly/parts/vertex_columns.h>
#include <trisect/bsp/assembly/parts/vertex_grid.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Splits edges at the candidate vertices that lie inside them. Holds scratch memory.
///
/// An edge looks at few candidates that are not near it: where they are many, some cubes of a grid,
/// or, if it is long, a column along an axis, or O(log n) boxes of a tree over them; else those
/// whose range along the longest axis meets its own. Of many, edges with the same ends look once:
/// mostly two facets have one.
class EdgeSplitter {
public:
    EdgeSplitter(const Workbench& bench, const PoolVector<BoundaryFacet>& facets)
        : bench_(bench), facets_(facets) {}
    void clear();
    void add_candidate(PointId p);
    /// Appends the parts of the edges to `out`, each edge's parts in order.
    void split(std::span<const BoundaryEdge> edges, BoundaryEdges& out);

private:
    using Candidate = VertexBoxes::Vertex;
    void sort_candidates(std::span<const BoundaryEdge> edges);
    [[nodiscard]] double short_length(std::span<const BoundaryEdge> edges) const;
    struct Inside {
        PointId from = -1;  // the edge that has looked
        PointId to = -1;
        std::uint32_t first = 0;  // of inside_
        std::uint32_t count = 0;
    };
    [[nodiscard]] Inside find_once(const BoundaryEdge& e);
    [[nodiscard]] std::uint32_t& slot_of(PointId from, PointId to);
    void make_slots(std::size_t n);
    void find_inside(const BoundaryEdge& e);
    void find_inside_sorted(const BoundaryEdge& e);
    void find_inside_near(const BoundaryEdge& e);
    [[nodiscard]] VertexColumns* columns_of(const BoundaryEdge& e);
    void look_at(const BoundaryEdge& e, const Candidate& candidate);
    void sort_inside(const BoundaryEdge& e, int axis, std::span<PointId> inside) const;

    const Workbench& bench_;
    const PoolVector<BoundaryFacet>& facets_;
    PoolVector<Candidate> candidates_;
    bool are_many_ = false;
    VertexGrid grid_;                       // of many candidates
    std::array<VertexColumns, 3> columns_;  // of these, once an edge is long and along an axis
    VertexBoxes boxes_;                     // once an edge is long
    std::vector<bool> is_listed_;           // by point: among the candidates
    std::size_t axis_ = 0;                  // that they are sorted along
    double widest_ = 0;                     // error of a candidate or an end
    PoolVector<PointId> inside_;            // of the edges that have looked, each along its edge
    PoolVector<Inside> known_;              // of many candidates
    PoolVector<std::uint32_t> slots_;       // of a hash table: 1 more than a place in known_, or 0
};

}  // namespace trisect::detail
