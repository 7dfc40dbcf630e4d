// SPDX-License-Identifier: Apache-2.0
//
// LevelLink: neighbours of a node of a grid of tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/brep/level_set/level_grid.h>

namespace trisect::detail {

/// The 24 tetrahedra at an inner node, each by its three other corners. They are numbers of its
/// neighbours: 0 to 7 across a cell (bits: up along x, y, z), 8 to 13 along an axis (8 + 2 k down,
/// 9 + 2 k up). Counter-clockwise seen from the node, or all the other way round.
class LevelLink {
public:
    static constexpr int neighbours = 14;
    using Triangle = std::array<std::uint8_t, 3>;

    [[nodiscard]] static std::span<const Triangle> triangles();
    [[nodiscard]] static NodePoint neighbour(const NodePoint& p, int which);

    /// Whether the surface between 1 and -1 goes around the node once: where signs of neighbours
    /// are 1, -1 or 0, and corners of 0 are on the surface, it meets the triangles in one closed
    /// curve. False where a triangle has three zeros.
    [[nodiscard]] static bool has_one_curve(const std::array<std::int8_t, neighbours>& signs);
};

}  // namespace trisect::detail
