// SPDX-License-Identifier: Apache-2.0
//
// Coincident polygons of a leaf, and the choice of their representative.
#pragma once

#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// Drops the pieces from `first` on that another item represents, and gives the others the step of
/// winding numbers across all that coincides there. \pre they are the pieces of one item.
void resolve_coincidence(LeafWork& work, std::size_t first);

/// Whether a piece lies in a polygon of the same plane. \pre the polygon has its edges.
[[nodiscard]] bool is_within(const Workbench& bench, const WorkPolygon& piece,
                             const WorkPolygon& other);

/// Of two coincident items, which one represents both?
[[nodiscard]] bool represents_before(const LeafWork& work, LeafIndex a, LeafIndex b);

}  // namespace trisect::detail
