// SPDX-License-Identifier: Apache-2.0
//
// BoundaryParts: the boundary of a result under construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/assembly/parts/assembly_stats.h>
#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/bsp/assembly/parts/facet_marks.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// The boundary in pieces, conforming within each facet's cells but not yet joined.
struct BoundaryParts {
    Workbench bench;
    std::vector<FacetMarks> sources;  ///< by serial
    /// Number of a source, whose facets must be among the parts.
    [[nodiscard]] std::size_t table_of(const Source* source) const {
        return static_cast<std::size_t>(table_ids.find(key_of(source)));
    }
    static Key128 key_of(const Source* source) {
        return {reinterpret_cast<std::uintptr_t>(source), 0};
    }
    FlatMap table_ids;
    PoolVector<BoundaryFacet> facets;  ///< cut, touched or spanning several cells; sorted
    BoundaryEdges edges;               ///< of these facets
    /// By point: the one that stands for all that equal it. Edges have no others.
    PoolVector<PointId> representatives;
    /// The edges are those of whole faces, and no vertex is left that means nothing.
    bool are_joined = false;
    /// All are outlines in general position: around each vertex that is no corner some facet turns,
    /// as its name says, since a part of each facet that the name has is in the result there.
    bool are_general = false;
    /// Corners of two sources that are one vertex, where facets of both pass through; else null.
    const EqualCorners* equal_corners = nullptr;
    std::array<const Source*, 2> equal_sources{};
    /// As CellTree::may_have_straight_crossings.
    bool may_have_straight_crossings = false;
    /// Edges inside facets in which their faces go straight across others, each in both directions.
    /// Joining adds them.
    BoundaryEdges crossings;
    AssemblyStats stats;
};

}  // namespace trisect::detail
