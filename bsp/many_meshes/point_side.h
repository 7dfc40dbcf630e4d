// SPDX-License-Identifier: Apache-2.0
//
// The side of an outlined solid's boundary that a point is on.
#pragma once

#include <cstddef>
#include <optional>

#include <trisect/bsp/many_meshes/common_segments.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/shifted_points.h>

namespace trisect::detail {

/// Whether the point is in the set; nothing when doubles cannot decide. `planes` are for the solid
/// with that number. O(n)
[[nodiscard]] std::optional<bool> is_open_at(const Approximation& point, const OutlinedSolid& solid,
                                             CommonSegments& planes, std::size_t number);

/// The same of a corner of another operand, exactly, as if operands were moved. O(n)
[[nodiscard]] bool is_open_at_corner(const OutlineVertex& corner, const OutlinedSolid& solid,
                                     const ShiftedPoints& exact);

}  // namespace trisect::detail
