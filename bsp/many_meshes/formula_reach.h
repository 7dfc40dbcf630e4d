// SPDX-License-Identifier: Apache-2.0
//
// Reach of a formula: a box around its boundary.
#pragma once

#include <optional>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// A box outside of which the formula has one value, by the boxes of its operands; nothing where
/// there is none. May be empty. \pre the operands are imported meshes
[[nodiscard]] std::optional<Box> reach_of(const Residual& formula, const SolidStates& solids);

}  // namespace trisect::detail
