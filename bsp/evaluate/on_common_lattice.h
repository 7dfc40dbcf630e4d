// SPDX-License-Identifier: Apache-2.0
//
// Conversion of operands on different lattices to a common one.
// It is the finest of them, and exact if all operands fit there.
#pragma once

#include <memory>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// Replaces every state that lies on another lattice than the common one, and returns that lattice
/// and what was rounded on the way to it. The common lattice is the finest lattice of an operand,
/// or the finest that is coarser and on which every operand fits. Solids on it already keep their
/// trees. Those that become finer are equal sets, unrefined, under the same names. Those that
/// become coarser are new sources whose corners were rounded; they may intersect themselves and are
/// to be resolved. \throw LimitError when rounding is refused, or would leave nothing of an
/// operand, or an operand is a half-space.
[[nodiscard]] LatticeReport move_to_common_lattice(
    std::vector<std::shared_ptr<const SolidState>>& states, EvaluateOptions::Lattices policy);

}  // namespace trisect::detail
