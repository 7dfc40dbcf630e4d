// SPDX-License-Identifier: Apache-2.0
//
// Reference points of cells, with their winding numbers.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/divide/cell_task.h>

namespace trisect::detail {

/// Both sides of a splitting plane.
using CellChildren = std::array<CellTask, 2>;

/// A leaf that someone refined stands for its refinement.
[[nodiscard]] const CellNode* unfolded(const CellNode* node);

/// Whether a point is beyond a box, as the reference points of imported meshes are.
[[nodiscard]] bool lies_outside(const FinePoint& p, const Box& box);

/// Winding number of a solid, given by the node of a cell, at a point of the cell; nothing when the
/// way to it from a point that is known there meets an edge or a vertex.
[[nodiscard]] std::optional<int> winding_in_tree(const CellNode& root, bool complemented,
                                                 const Cell& cell, const FinePoint& p);

/// Gives a child of the task's cell its reference point and its operands their winding numbers
/// there. \pre both children have their operands. False when no point was found.
[[nodiscard]] bool place_reference(const CellTask& task, const SplittingPlane& splitter, int which,
                                   CellChildren& children);

}  // namespace trisect::detail
