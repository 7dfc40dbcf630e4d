// SPDX-License-Identifier: Apache-2.0
//
// Cell sections: the intersection of each plane of a BspTree with its cell.
// They are the only geometry that merging and boundary extraction need. (Thibault and Naylor call
// them sub-hyperplanes.)
#pragma once

#include <vector>

#include <trisect/bsp/bsp_tree.h>
#include <trisect/kernel/convex_polygon.h>

namespace trisect {

/// The part of a plane in the space of BspTree, the cube |coordinate| <= 2^53, oriented as the
/// plane. Empty when the plane misses the interior of the cube.
[[nodiscard]] ConvexPolygon section_of_space(const Plane& plane);

/// Element i is the section of node i: the node's plane within the closure of the node's cell,
/// oriented as the plane. It is empty exactly where the plane does not cut the cell, that is where
/// the tree breaks the second invariant of BspTree.
/// Cost: O(sum of the nodes' depths), which is quadratic for convex solids.
[[nodiscard]] std::vector<ConvexPolygon> cell_sections(const BspTree& tree);

}  // namespace trisect
