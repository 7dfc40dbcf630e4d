// SPDX-License-Identifier: Apache-2.0
//
// Removal of what outlines of moved meshes leave without thickness.
#pragma once

#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Where two facets in special position lie in one plane and face opposite ways, what their
/// outlines have in common bounds a gap or a sheet of no thickness: both lose it. Edges of one
/// that run through what the other one loses go over to that. Points in which edges in one plane
/// cross are made, and inserted into all edges. False where it is not known what is common. \pre
/// the edges are of facets in special position, and their vertices are inserted; points may still
/// be named
[[nodiscard]] bool remove_sheets(BoundaryParts& parts, PoolVector<PointId>& representatives,
                                 BoundaryEdges& edges);

}  // namespace trisect::detail
