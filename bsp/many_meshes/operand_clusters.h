// SPDX-License-Identifier: Apache-2.0
//
// Clusters of operands: their boxes hang together, and others are apart.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

/// Those of some operands that are joined by boxes that meet, also by others in between; each
/// cluster ascending, and clusters in the order of their first operands. Boxes that touch meet.
/// `slots`: which boxes, ascending. O(n log n + n m) for m boxes across a plane.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> operand_clusters(
    std::span<const Box> boxes, std::span<const std::uint32_t> slots);

/// Puts slots in an order in which the first half lies on one side of the second one, and so on in
/// each half, as far as the middles of boxes go.
void order_in_space(std::span<const Box> boxes, std::span<std::uint32_t> slots);

}  // namespace trisect::detail
