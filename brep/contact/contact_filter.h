// SPDX-License-Identifier: Apache-2.0
//
// Triangles that have nothing in common, as far as doubles say so.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// True only if two triangles have nothing in common but the corners that they share, `shared` of
/// them. \pre shared < 3
[[nodiscard]] bool are_plainly_apart(std::span<const LatticePoint> points,
                                     const std::array<std::uint32_t, 3>& a,
                                     const std::array<std::uint32_t, 3>& b, int shared);

}  // namespace trisect::detail
