// SPDX-License-Identifier: Apache-2.0
//
// Polygons of a leaf that cover each other: who speaks for them.
#pragma once

#include <trisect/bsp/detail/leaf_work.h>

namespace trisect::detail {

/// Drops the pieces from `first` on for which another item speaks, and gives the others the step of
/// winding numbers across all that coincides there. \pre they are the pieces of one item.
void resolve_coincidence(LeafWork& work, std::size_t first);

}  // namespace trisect::detail
