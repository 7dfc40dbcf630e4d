// SPDX-License-Identifier: Apache-2.0
//
// Orientation of a closed shell, the sign of its volume.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// -1, 0 or 1, exact: positive when the triangles are counter-clockwise seen from outside.
/// For an open surface the volume of the cone to the first corner. O(n).
[[nodiscard]] int volume_sign(std::span<const LatticePoint> points,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace trisect::detail
