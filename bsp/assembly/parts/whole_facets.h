// SPDX-License-Identifier: Apache-2.0
//
// WholeFacets: unmodified facets, and those with coplanar neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/boundary_vertices.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

struct WholeFacet {
    std::uint32_t table = 0;  ///< number of its source in BoundaryParts
    std::uint32_t facet = 0;
    bool flipped = false;
    bool joins = false;  ///< shares an edge with a facet of its plane and becomes part of its face
    /// In the order of the result's face.
    std::array<BoundaryVertices::Index, 3> corners{};
};

/// Whether a facet and its neighbour, already known to lie in one oriented plane, may become one
/// face: always, or with `within_faces` when they are parts of one face of one operand.
[[nodiscard]] bool may_join(const BoundaryFacet& a, const BoundaryFacet& b, bool within_faces);

/// All facets that pass through, in the order of facets. `edges` are those of the facets that do
/// not. O(n log n): one counting sort of directed edges; planes are compared exactly only where
/// doubles cannot distinguish them.
[[nodiscard]] PoolVector<WholeFacet> list_whole_facets(const BoundaryParts& parts,
                                                       std::span<const BoundaryEdge> edges,
                                                       bool within_faces,
                                                       BoundaryVertices& vertices);

struct BrokenEdge;

/// Gives the facets that join edges, with the vertices inside broken ones: adds them to the facets
/// of `parts`, which stay sorted, and their edges to `edges`.
void add_joining_facets(std::span<const WholeFacet> whole, std::span<const BrokenEdge> broken,
                        BoundaryVertices& vertices, BoundaryParts& parts, BoundaryEdges& edges);

}  // namespace trisect::detail
