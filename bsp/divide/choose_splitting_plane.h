// SPDX-License-Identifier: Apache-2.0
//
// Choice of a splitting plane for a cell without one.
#pragma once

#include <cstdint>
#include <optional>

#include <trisect/bsp/divide/cell_task.h>

namespace trisect::detail {

/// The splitting plane that separates the operands soonest: it trims off a slab that only one of
/// them enters, when that is at least 30 % of the extent; else it halves the box of what at least
/// two enter (or what an operand that has to be resolved by itself enters). Where a half-space is
/// listed, walls beside all other operands come first: its plane is left out of cells that it
/// misses, and a cell without end it hardly ever misses. Nothing when the
/// polygons cannot be separated in the task's frame. `offset` is that of splitting planes from
/// lattice positions, in 1/192 units. \pre all operands are lists.
[[nodiscard]] std::optional<SplittingPlane> choose_splitting_plane(const CellTask& task,
                                                                   std::int64_t offset);

/// The extent of what choose_splitting_plane() would halve, in rounded positions.
[[nodiscard]] int contested_extent(const CellTask& task);

}  // namespace trisect::detail
