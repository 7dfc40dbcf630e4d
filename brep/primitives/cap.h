// SPDX-License-Identifier: Apache-2.0
//
// Caps: triangles that fill an outline with holes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// `points` lie in the plane z = 0; the first loop is counter-clockwise and the others, its holes,
/// clockwise. The triangles use all corners.
/// \throw UsageError when the loops cross each other.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate_cap(
    std::span<const LatticePoint> points, std::span<const std::vector<std::uint32_t>> loops);

}  // namespace trisect::detail
