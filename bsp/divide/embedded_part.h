// SPDX-License-Identifier: Apache-2.0
//
// Embedded parts of meshes that meet themselves in other cells.
#pragma once

#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Makes an operand an embedded one where none of its facets in the cell meets others: facets that
/// do not bound the set leave the list. False, and nothing is done, where it was one before, some
/// facet meets others, or kinds are not known (facet_kinds.h).
/// \pre inside is a positive winding number
bool take_as_embedded(CellOperand& operand, StackArena& arena);

}  // namespace trisect::detail
