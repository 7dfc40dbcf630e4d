// SPDX-License-Identifier: Apache-2.0
//
// Edges of a result with outlined facets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>

namespace trisect::detail {

/// Appends the edges of the facets and marks those as traced. `sources` are by operand. \pre the
/// facets are present and worked on in the marks, and numbered. `threads` as in ParallelParts
void add_outlined(const OutlinedFacets& outlined, const Crossings& operands,
                  std::span<const Source* const> sources, BoundaryParts& parts,
                  BoundaryEdges& edges, std::uint32_t threads);

}  // namespace trisect::detail
