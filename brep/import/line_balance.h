// SPDX-License-Identifier: Apache-2.0
//
// Line balance: cancellation of directed edges as intervals of their lines.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// An edge between two different points whose traversals do not cancel: from -> to `count` times
/// more often than back.
struct NetEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int64_t count = 0;
};

/// Of each edge, whether some part of it is left over after all edges of its line are added up.
/// All false: the boundary is closed, although corners may lie inside other faces' edges.
/// O(n log n), exact.
[[nodiscard]] std::vector<bool> find_uncancelled(std::span<const LatticePoint> points,
                                                 std::span<const NetEdge> edges);

}  // namespace trisect::detail
