// SPDX-License-Identifier: Apache-2.0
//
// Side balance: equal numbers of traversals of every edge in both directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trisect::detail {

struct SideBalance {
    bool cancel = false;            ///< exactly when find_net_edges of the same triangles is empty
    bool reach_all_points = false;  ///< each is a corner of a triangle of three points
};

/// Says nothing about where sides do not cancel. Sides that join a point to itself do not count.
/// O(n), and 65 bytes a point; what goes beyond eight triangles at a point is sorted.
/// `threads`: how many may take part, 0 means as many as there are here; each reads all triangles.
/// The outcome does not depend on it. \pre every corner is less than point_count; fewer than 2^30
/// triangles.
[[nodiscard]] SideBalance balance_sides(std::size_t point_count,
                                        std::span<const std::array<std::uint32_t, 3>> triangles,
                                        std::uint32_t threads = 1);
/// The same; triangle i has the corners 3 i, 3 i + 1 and 3 i + 2.
[[nodiscard]] SideBalance balance_sides(std::size_t point_count,
                                        std::span<const std::uint32_t> corners);

}  // namespace trisect::detail
