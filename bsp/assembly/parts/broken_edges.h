// SPDX-License-Identifier: Apache-2.0
//
// BrokenEdge: an edge with vertices of the result inside it.
// What touches an edge of a facet from within a cell shows in that cell, and then the facet has not
// passed through. But where facets of another operand stand for parts of coincident ones, their
// corners lie where bounding planes of cells meet, and that may be on an edge: of facets that have
// no area in the cell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/whole_facets.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

struct BrokenEdge {
    std::size_t whole = 0;       ///< number of the facet
    int edge = 0;                ///< from that corner of the facet to the next one
    PoolVector<PointId> inside;  ///< in the order along it
};

/// In the order of facets, which have to join. `edges` are those of the facets that did not pass
/// through, sorted by facet. O(n log n) for n edges, and a look at all of `whole` only if a facet
/// across such an edge is not among them.
[[nodiscard]] PoolVector<BrokenEdge> find_broken_edges(const BoundaryParts& parts,
                                                       std::span<const BoundaryEdge> edges,
                                                       std::span<WholeFacet> whole);

}  // namespace trisect::detail
