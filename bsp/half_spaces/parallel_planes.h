// SPDX-License-Identifier: Apache-2.0
//
// Order of parallel half-spaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/kernel/plane.h>

namespace trisect::detail {

/// One side of a plane.
struct PlaneSide {
    Plane plane;
    bool below = true;
};

/// Those of parallel planes whose sides have the same intersection as all of them together: one, or
/// two that face each other. Ascending numbers; exact. Nothing where planes are not parallel, where
/// two of them are the same set of points, or where the intersection is empty.
[[nodiscard]] std::optional<std::vector<std::size_t>> tight_sides(std::span<const PlaneSide> sides);

/// Whether planes are parallel, look the same way, and each is above the one before. Exact.
[[nodiscard]] bool are_ascending(std::span<const Plane> planes);

}  // namespace trisect::detail
