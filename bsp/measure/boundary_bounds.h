// SPDX-License-Identifier: Apache-2.0
//
// Bounds of a result from the facets that assembly gathers.
#pragma once

#include <optional>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// Correctly rounded, in the user's units; nothing for a boundary without facets. A vertex is
/// rounded only where it may be an end along an axis.
/// \pre the solid is bounded, and its boundary does not meet itself.
[[nodiscard]] std::optional<Bounds> boundary_bounds(const SolidState& solid);

}  // namespace trisect::detail
