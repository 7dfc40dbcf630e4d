// SPDX-License-Identifier: Apache-2.0
//
// Division of a polygon of a leaf into convex pieces.
#pragma once

#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// Clips an item to the cell and splits it along its cutters and the edges of overlapping polygons.
/// The pieces are appended to the work's list; each is on one side of everything else in the leaf.
/// Returns whether two cutters of different planes cut the item along one line
/// (straight_crossings.h).
bool make_pieces(LeafWork& work, LeafIndex item);

}  // namespace trisect::detail
