// SPDX-License-Identifier: Apache-2.0
//
// Facets of one plane joined to one face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>

namespace trisect::detail {

/// Marks the facets whose edges are those of their source's facet: touched in vain. Whether such a
/// facet has edges at all depends on the tree. \pre edges sorted by facet, straight vertices
/// removed. `threads` as in ParallelParts.
void mark_unchanged_facets(BoundaryParts& parts, std::span<const BoundaryEdge> edges,
                           std::uint32_t threads = 1);

/// Renumbers `facet` of every edge to the smallest facet of its face: facets in one oriented plane
/// that share an edge are joined and the edge vanishes, unless facets of another plane go straight
/// across there. With `within_faces` only facets of the same
/// face of the same operand are, and facets marked as unchanged never. The edges come out sorted by
/// facet. Returns how many facets became part of another one's face.
/// `threads` as in ParallelParts; if not 1 the bench of the parts has to be shared.
std::size_t join_coplanar_facets(const BoundaryParts& parts, bool within_faces,
                                 BoundaryEdges& edges, std::uint32_t threads = 1);

/// Renumbers `facet` of the edges in axis-perpendicular planes to the first facet of their plane
/// and facing, so that a plane is one region whichever way its outline was found (axis_faces.h).
/// Facets marked as unchanged stay. \pre sorted by facet; so they come out. `threads` as in
/// ParallelParts.
void join_planes_across_axes(const BoundaryParts& parts, BoundaryEdges& edges,
                             std::uint32_t threads = 1);

}  // namespace trisect::detail
