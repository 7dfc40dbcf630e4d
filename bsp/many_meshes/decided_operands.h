// SPDX-License-Identifier: Apache-2.0
//
// Operands that make no difference: a larger one decides the formula all around them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/many_meshes/outlines/nested_formula.h>

namespace trisect::detail {

/// By slot: whether the operand may be left out of the operation that it is a term of. So may a
/// small one in a union, if that is intersected with large operands all of which are outside of
/// themselves around its box. A decision for some of them only; none for few operands.
/// `open_far_out`: by slot, whether it leaves open what is far out. `threads` as for ParallelParts.
/// O(n) for n facets and operands.
[[nodiscard]] std::vector<std::uint8_t> decided_operands(const NestedFormula& nested,
                                                         std::span<const Source* const> sources,
                                                         std::span<const std::uint8_t> open_far_out,
                                                         std::uint32_t threads);

}  // namespace trisect::detail
