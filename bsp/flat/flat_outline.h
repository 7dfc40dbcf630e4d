// SPDX-License-Identifier: Apache-2.0
//
// Outlines of formulas over regions of the plane.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/flat/flat_arrangement.h>

namespace trisect::detail {

/// The formula is over the operands' slots, in their order. The value far away must be 0. Lines
/// keep their names; the lattice, and names of caps, are the caller's. O(n log n) beside the
/// divided arrangement, if formulas are flat.
[[nodiscard]] FlatRegion flat_outline(const FlatArrangement& arrangement,
                                      std::span<const std::int32_t> slots, const Residual& formula,
                                      const EvaluateSettings& settings);

/// The outline of one region. \pre it has none
[[nodiscard]] FlatRegion resolved_region(const FlatRegion& region);

}  // namespace trisect::detail
