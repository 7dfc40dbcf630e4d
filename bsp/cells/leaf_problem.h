// SPDX-License-Identifier: Apache-2.0
//
// LeafProblem: input of a leaf arrangement: a cell, operands and the formula.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// Number of an item, a piece or an operand of a leaf.
using LeafIndex = std::int32_t;

/// An operand of the formula in one cell.
struct LeafOperand {
    std::int32_t slot = -1;
    std::span<const PolygonRef> polygons;
    bool flipped = false;  ///< the polygons are to be read with the other orientation
    /// The polygons do not cross, overlap or touch each other except in common edges and vertices,
    /// and the winding number is 0 outside and 1 inside.
    bool embedded = false;
    int winding = 0;  ///< at the reference point
};

struct LeafProblem {
    Cell cell;
    FinePoint reference;
    std::span<const LeafOperand> operands;
    const Residual* formula = nullptr;
    const EvaluateSettings* options = nullptr;
    /// The polygons are not needed yet: what takes long may be left out, if it can be done later.
    bool may_defer = false;
};

/// inside = winding number > 0, or != 0.
[[nodiscard]] inline bool is_inside(int winding, EvaluateOptions::Winding rule) {
    return rule == EvaluateOptions::Winding::Positive ? winding > 0 : winding != 0;
}

}  // namespace trisect::detail
