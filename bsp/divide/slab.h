// SPDX-License-Identifier: Apache-2.0
//
// Operands that are half-space pairs in a cell.
// They are common where many parts have coplanar caps.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/cell_task.h>

namespace trisect::detail {

/// What an operand has of a cell where all its polygons are perpendicular to one axis: the space
/// between two positions, in 1/192 lattice units, or beyond one of them. The cell's bounding planes
/// stand for no bound.
struct Slab {
    std::int32_t slot = -1;
    std::size_t axis = 0;
    std::int64_t lo = 0;
    std::int64_t hi = 0;
};

/// Nothing when the operand is something else, or looking would take long.
[[nodiscard]] std::optional<Slab> slab_of(const CellOperand& operand, const CellTask& task);

/// Finds the operands of unions that lie within another operand of the union that is a slab, and
/// sets their values to outside. Facets that lie in a bound of the slab and reach into other cells
/// are missing in this one: they are added to `incomplete`. Returns whether there are any.
bool find_contained(const CellTask& task, SlotValues& values, std::vector<FacetName>& incomplete);

}  // namespace trisect::detail
