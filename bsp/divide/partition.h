// SPDX-License-Identifier: Apache-2.0
//
// Polygon lists from leaves, and their distribution by a splitting plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Where the bounded polygons of an operand's leaf or list lie, exactly, within a cell. Linear in
/// the polygons, unless the leaf has all facets of a source.
[[nodiscard]] Box exact_box(const CellOperand& operand, const Cell& cell);

/// Makes a list of an operand that is a leaf; keeps the polygons' boxes in the task's frame.
/// `threads` as in ParallelParts, here and below.
void open_leaf(CellOperand& operand, const CellTask& task, StackArena& arena,
               std::uint32_t threads);

/// Makes a list's boxes anew, in another frame of the task.
void reframe(CellOperand& operand, const CellTask& task, StackArena& arena);

/// Distributes the lists of a task to the cells below and above a splitting plane; `out` are copies
/// of its operands, of which entries, counts and boxes of lists are set. In short lists a facet
/// that is long for its cell is looked at itself, since it may pass by a cell that its box meets.
void partition(const CellTask& task, const SplittingPlane& splitter,
               const std::array<Cell, 2>& cells, StackArena& arena, std::uint32_t threads,
               const std::array<std::span<CellOperand>, 2>& out);

/// What of a cell lies within the limits of a frame, rounded outwards.
[[nodiscard]] PackedBox packed_cell(const Frame& frame, const Cell& cell);

}  // namespace trisect::detail
