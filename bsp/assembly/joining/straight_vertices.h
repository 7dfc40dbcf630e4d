// SPDX-License-Identifier: Apache-2.0
//
// Removal of vertices at which no face turns.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>

namespace trisect::detail {

/// Removes every vertex at which all regions that have it run straight on. With `keep_corners`
/// corners of the operands stay, and in any case the points of `keep` do. \pre edges sorted by
/// facet. `threads` as in join_coplanar_facets.
void remove_straight_vertices(const BoundaryParts& parts, bool keep_corners,
                              std::span<const PointId> keep, BoundaryEdges& edges,
                              std::uint32_t threads = 1);

}  // namespace trisect::detail
