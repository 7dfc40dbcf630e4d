// SPDX-License-Identifier: Apache-2.0
//
// Fans of triangles around a corner of many.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Makes the triangles around each of the `hubs` one sheet, counted from `next` on, but for those
/// that meet others around it; leaves those that a sheet has as a whole. What is left of a sheet is
/// one as before. A triangle of two hubs goes to the first one. Equal corners may have different
/// names. O(n log n) for ordinary fans; where triangles lie above each other, as seen from their
/// hub, nothing is done. \return the number of the next sheet
std::uint32_t add_fans(std::span<const LatticePoint> points,
                       std::span<const std::array<std::uint32_t, 3>> triangles,
                       std::span<const std::uint32_t> hubs, std::uint32_t next,
                       std::vector<std::uint32_t>& sheets);

}  // namespace trisect::detail
