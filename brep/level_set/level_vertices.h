// SPDX-License-Identifier: Apache-2.0
//
// LevelVertices: vertices of level sets, by nodes and edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/brep/level_set/level_crossings.h>
#include <trisect/brep/level_set/level_grid.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// In the order of nodes: one at the node itself, where the surface goes through it, or a side of
/// the box has it for a corner; then those of its edges.
class LevelVertices {
public:
    /// Refers to the grid and the signs.
    LevelVertices(const LevelGrid& grid, std::span<const LevelCrossing> crossings,
                  const std::vector<std::int8_t>& signs,
                  const std::unordered_map<std::size_t, Point3d>& moved);

    [[nodiscard]] std::uint32_t at_node(const NodePoint& p) const;
    /// \pre an edge of the grid whose ends have the signs 1 and -1
    [[nodiscard]] std::uint32_t on_edge(const NodePoint& p, const NodePoint& q) const;
    [[nodiscard]] const std::vector<Point3d>& places() const { return places_; }

private:
    // Bits of directions, and this one for the node itself.
    static constexpr std::uint16_t itself = 1U << 15U;

    void add_node(std::size_t node, const Point3d& place);
    [[nodiscard]] bool is_corner_of_side(const NodePoint& p) const;
    void add_edges(std::span<const LevelCrossing> crossings);

    const LevelGrid& grid_;
    const std::vector<std::int8_t>& signs_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint16_t> mask_;
    std::vector<Point3d> places_;
};

}  // namespace trisect::detail
