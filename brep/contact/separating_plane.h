// SPDX-License-Identifier: Apache-2.0
//
// Planes between two triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// True only if some plane has the corners of both triangles strictly on its two sides, but for
/// one corner that they share, through which it goes. It is searched for in a few steps. \pre they
/// share one corner or none
[[nodiscard]] bool have_plane_between(std::span<const LatticePoint> points,
                                      const std::array<std::uint32_t, 3>& a,
                                      const std::array<std::uint32_t, 3>& b);

}  // namespace trisect::detail
