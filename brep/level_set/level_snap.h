// SPDX-License-Identifier: Apache-2.0
//
// Nodes of a grid that move onto the surface.
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

/// Moves inner nodes to crossings on their edges, nearest ones first, where these are within a
/// quarter of the edge, all tetrahedra keep an eighth of their volume, and the surface still goes
/// once around each node that moved. Sets their signs to 0: crossings on their edges are no
/// vertices any more. Returns their places.
[[nodiscard]] std::unordered_map<std::size_t, Point3d> move_nodes_to_surface(
    const LevelGrid& grid, std::span<const LevelCrossing> crossings,
    std::vector<std::int8_t>& signs);

}  // namespace trisect::detail
