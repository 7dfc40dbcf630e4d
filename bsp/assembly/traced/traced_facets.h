// SPDX-License-Identifier: Apache-2.0
//
// Traced facets: outlines of cut facets from their crossing segments.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/crossings.h>

namespace trisect::detail {

/// Appends the edges of the facets whose outlines follow from their crossings, and marks those
/// facets as traced. All others are left as they are. O(n log n). `threads`: 1, or 0 for as many as
/// there are here; the outcome does not depend on it. \pre worked facets are numbered.
void trace_facets(const Crossings& crossings, BoundaryParts& parts, BoundaryEdges& edges,
                  std::uint32_t threads = 1);

}  // namespace trisect::detail
