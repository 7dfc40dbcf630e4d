// SPDX-License-Identifier: Apache-2.0
//
// Polygon list of the single operand left in a cell.
#pragma once

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// The polygons of an operand's list, as a leaf of the task's cell lists them: those whose boxes
/// meet the cell. Where none certainly lies in the cell, those that do not meet it are taken out,
/// so a list that is not empty is not homogeneous only because it was not tested. `complemented`:
/// the leaf is the operand's complement. Linear. \pre operand.is_list.
[[nodiscard]] PolygonList shared_list(const CellTask& task, const CellOperand& operand,
                                      bool complemented, Workbench& bench, StackArena& arena);

}  // namespace trisect::detail
