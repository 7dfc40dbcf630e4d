// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of solids.
#pragma once

#include <span>

#include <trisect/bsp/solid.h>

namespace trisect {

/// The convex hull of all solids together. Exact over the corners of their meshes: corners that
/// booleans have made and that are no doubles are rounded first, once. The empty set where nothing
/// is.
/// \throw UnsupportedError for an unbounded set, LimitError for coordinates that span more than 126
/// bits
[[nodiscard]] Solid hull(std::span<const Solid> solids);
[[nodiscard]] Solid hull(const Solid& solid);

}  // namespace trisect
