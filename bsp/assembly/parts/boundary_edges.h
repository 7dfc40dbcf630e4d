// SPDX-License-Identifier: Apache-2.0
//
// Cancellation of edges inside a region, and removal of redundant vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>

namespace trisect::detail {

/// Puts the edges into the order of their facets; those of one facet stay in theirs.
void sort_by_facet(const BoundaryParts& parts, BoundaryEdges& edges);

/// Arranges the edges of every facet (EdgeChains). \pre sorted by facet
void arrange_loops(std::span<BoundaryEdge> edges);

/// Joins the parts of every facet: edges that two parts traverse in opposite directions vanish,
/// unless facets of another plane go straight across there (crossing_faces.h).
/// Where parts of neighbouring cells subdivide a common line differently, their ends are inserted
/// first. The edges come out sorted by facet. \throw UnsupportedError when a part ends at the limit
/// of space (an unbounded face). `threads` as in join_coplanar_facets.
void join_facets(const BoundaryParts& parts, BoundaryEdges& edges, std::uint32_t threads = 1);

/// Inserts vertices that lie inside edges into those that no other edge runs against: where two
/// facets in one plane cross another one, that one has an edge along both. \pre sorted by facet; so
/// they come out.
void conform_unmatched_edges(const BoundaryParts& parts, BoundaryEdges& edges);

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

/// Removes every vertex at which all regions that have it run straight on. With `keep_corners`
/// corners of the operands stay, and in any case the points of `keep` do. \pre edges sorted by
/// facet. `threads` as in join_coplanar_facets.
void remove_straight_vertices(const BoundaryParts& parts, bool keep_corners,
                              std::span<const PointId> keep, BoundaryEdges& edges,
                              std::uint32_t threads = 1);

}  // namespace trisect::detail
