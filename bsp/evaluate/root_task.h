// SPDX-License-Identifier: Apache-2.0
//
// Root task of an evaluation.
#pragma once

#include <memory>
#include <span>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// The universe as a cell: the formula, a reference point, and one operand a solid with its winding
/// number there. The operands lie in the arena. Linear in the number of solids when a point outside
/// of all of them is free to see; a solid with a tree costs one way down it.
[[nodiscard]] CellTask root_task(const Residual::Ref& formula,
                                 std::span<const std::shared_ptr<const SolidState>> solids,
                                 StackArena& arena);
/// The same for one cell. \pre the solids' roots are leaves of it with one reference point in it
[[nodiscard]] CellTask task_in_cell(const Residual::Ref& formula,
                                    std::span<const std::shared_ptr<const SolidState>> solids,
                                    const Cell& cell, StackArena& arena);

}  // namespace trisect::detail
