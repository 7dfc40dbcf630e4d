// SPDX-License-Identifier: Apache-2.0
//
// Side balance: is every edge of a triangle mesh traversed as often one way as the other?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trisect::detail {

/// True exactly when find_net_edges of the same triangles is empty; says nothing about where not.
/// Sides that join a point to itself do not count. O(n), and 4 bytes a side.
/// \pre every corner is less than point_count; fewer than 2^30 triangles.
[[nodiscard]] bool sides_cancel(std::size_t point_count,
                                std::span<const std::array<std::uint32_t, 3>> triangles);
/// The same; triangle i has the corners 3 i, 3 i + 1 and 3 i + 2.
[[nodiscard]] bool sides_cancel(std::size_t point_count, std::span<const std::uint32_t> corners);

}  // namespace trisect::detail
