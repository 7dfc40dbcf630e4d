// SPDX-License-Identifier: Apache-2.0
//
// Crossings of triangles that show that solids overlap.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/relation/boundary.h>

namespace trisect::detail {

/// Whether triangles i of A and j of B, which certainly cross, show that the solids overlap. They
/// do unless other parts of either boundary lie just where they cross: for clear triangles, and
/// where at some point of the crossing certainly nothing else of either boundary is near. A
/// microsecond. `to_a` is the map from B into A.
[[nodiscard]] bool crossing_tells(const Boundary& a, std::uint32_t i, const Boundary& b,
                                  std::uint32_t j, const ApproximateMap& to_a);

}  // namespace trisect::detail
