// SPDX-License-Identifier: Apache-2.0
//
// Faces of the surface between signs at the nodes of a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/brep/level_set/level_crossings.h>
#include <trisect/brep/level_set/level_grid.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// The boundary of what is 1, outward to what is -1 or beyond the box. Nodes of sign 0 are on it,
/// at the places that they moved to. \pre the crossings are all of the signs before nodes moved
[[nodiscard]] PolygonMesh level_faces(const LevelGrid& grid,
                                      std::span<const LevelCrossing> crossings,
                                      const std::vector<std::int8_t>& signs,
                                      const std::unordered_map<std::size_t, Point3d>& moved);

}  // namespace trisect::detail
