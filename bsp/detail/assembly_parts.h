// SPDX-License-Identifier: Apache-2.0
//
// First half of assembly: from the polygons of the cells to directed edges between exact vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/detail/assembly_stats.h>
#include <trisect/bsp/detail/boundary_facet.h>
#include <trisect/bsp/detail/facet_marks.h>
#include <trisect/bsp/detail/flat_map.h>
#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/workbench.h>

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
    std::vector<BoundaryFacet> facets;  ///< cut, touched or spanning several cells; sorted
    std::vector<BoundaryEdge> edges;    ///< of these facets
    /// By point: the one that stands for all that equal it. Edges have no others.
    std::vector<PointId> representatives;
    /// The edges are those of whole faces, and no vertex is left that means nothing.
    bool are_joined = false;
    AssemblyStats stats;
};

/// Facets that nothing cuts or touches are marked whole in `sources` and have no edges.
/// `by_planes`: the facets of a plane will be joined, so that they may come as one where that is
/// easier (axis_faces.h). `threads` as in ParallelParts.
void gather_parts(const SolidState& solid, BoundaryParts& parts, bool by_planes,
                  std::uint32_t threads = 1);

/// Whether all that the walls of a cell could cut off a fragment has been cut off: its box is
/// rounded outwards and says too much where it ends at a wall.
[[nodiscard]] bool ends_at_walls(const Fragment& fragment, const Cell& cell);

}  // namespace trisect::detail
