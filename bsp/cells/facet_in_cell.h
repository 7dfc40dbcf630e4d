// SPDX-License-Identifier: Apache-2.0
//
// Quick rejection of a facet whose box meets a cell.
#pragma once

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// True only when no point of the facet lies in the closed box or near it. For boxes of cells that
/// long thin facets pass by; about 50 ns. Works in doubles with a margin far beyond their rounding,
/// so it may answer false for a facet that just misses, never true for one that touches.
[[nodiscard]] bool certainly_misses(const PolygonRef& ref, const Box& box);

}  // namespace trisect::detail
