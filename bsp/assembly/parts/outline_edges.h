// SPDX-License-Identifier: Apache-2.0
//
// Edges of a result with outlines given by name.
#pragma once

#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/named_outlines.h>

namespace trisect::detail {

/// Appends the edges. \pre the faces are present and worked on in the marks, and numbered; all
/// sources that name corners have marks.
void add_outlines(const NamedOutlines& outlines, BoundaryParts& parts, BoundaryEdges& edges);

}  // namespace trisect::detail
