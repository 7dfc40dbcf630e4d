// SPDX-License-Identifier: Apache-2.0
//
// First half of assembly: directed edges between exact vertices.
// They come from the polygons of the cells.
#pragma once

#include <cstdint>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// Facets that nothing cuts or touches are marked whole in `sources` and have no edges.
/// `by_planes`: the facets of a plane will be joined, so that they may come as one where that is
/// easier (axis_faces.h). `threads` as in ParallelParts.
void gather_parts(const SolidState& solid, BoundaryParts& parts, bool by_planes,
                  std::uint32_t threads = 1);

}  // namespace trisect::detail
