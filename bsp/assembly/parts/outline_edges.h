// SPDX-License-Identifier: Apache-2.0
//
// Edges of a result with outlines given by name.
#pragma once

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Planes and points of outlines.
struct OutlineNames {
    PoolVector<PlaneId> supports;  ///< by face
    BoundaryEdges edges;           ///< `facet` is the number of the face in the outlines
};

/// Touches nothing but the bench: marks may be made at the same time.
[[nodiscard]] OutlineNames name_outlines(const NamedOutlines& outlines, Workbench& bench);

/// Appends the edges. \pre the faces are present and worked on in the marks, and numbered; all
/// sources that name corners have marks.
void add_outlines(const NamedOutlines& outlines, OutlineNames names, BoundaryParts& parts,
                  BoundaryEdges& edges);

}  // namespace trisect::detail
