// SPDX-License-Identifier: Apache-2.0
//
// Cells that many operands fill.
#pragma once

#include <trisect/bsp/divide/cell_task.h>

namespace trisect::detail {

/// Whether the boxes of what the operands have in the cell mostly overlap: then splitting planes
/// part facets from each other, but no operand from another one. False where one of them has a
/// tree.
[[nodiscard]] bool is_crowded(const CellTask& task);

}  // namespace trisect::detail
