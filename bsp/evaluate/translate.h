// SPDX-License-Identifier: Apache-2.0
//
// Translation of an expression over solids to a formula over numbered slots.
#pragma once

#include <vector>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// The formula over slots; the same solid, and a mesh with many
/// facets that was imported twice, share a slot.
struct Translation {
    Residual::Ref formula;
    std::vector<Solid> slots;
};

/// \throw LimitError when the formula nests more than 4096 alternating operations.
[[nodiscard]] Translation translate(const Expression& expression);

/// The empty set and whole space are values in the formula and no slots, unless there is nothing
/// else.
[[nodiscard]] Translation translate_without_constants(const Expression& expression);

}  // namespace trisect::detail
