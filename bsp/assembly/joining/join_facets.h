// SPDX-License-Identifier: Apache-2.0
//
// Parts of facets joined to one region for each facet.
#pragma once

#include <cstdint>

#include <trisect/bsp/assembly/parts/boundary_parts.h>

namespace trisect::detail {

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

}  // namespace trisect::detail
