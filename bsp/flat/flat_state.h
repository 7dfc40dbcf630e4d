// SPDX-License-Identifier: Apache-2.0
//
// Solids that are prisms over regions of the plane.
#pragma once

#include <memory>

#include <trisect/bsp/cells/flat/flat_region.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/kernel/coordinate.h>

namespace trisect::detail {

/// The prism along an axis: u and v are the next axes. Its tree is made when it is needed.
/// \pre low < high, in units of the region's lattice
[[nodiscard]] std::shared_ptr<SolidState> flat_state(FlatRegion region, int axis, Coordinate low,
                                                     Coordinate high);

/// Its tree: one leaf, of facets of a mesh where all vertices are corners, else of fragments.
[[nodiscard]] std::shared_ptr<const SolidState> flat_tree(const FlatRegion& region, int axis,
                                                          Coordinate low, Coordinate high);

}  // namespace trisect::detail
