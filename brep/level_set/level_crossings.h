// SPDX-License-Identifier: Apache-2.0
//
// LevelCrossing: crossings of edges of a grid with a level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/level_set/level_grid.h>
#include <trisect/brep/level_set/level_set_mesh.h>
#include <trisect/brep/level_set/level_values.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// A crossing is named by the first end of its edge and its direction.
struct LevelCrossing {
    std::size_t node = 0;
    int direction = 0;
    double at = 0;  ///< 0 at the first end, 1 at the other
};

/// The place on an edge, rounded once on each axis; on an edge along an axis it is exactly on it.
[[nodiscard]] Point3d place_on_edge(const LevelGrid& grid, const LevelCrossing& crossing);
[[nodiscard]] std::size_t other_end(const LevelGrid& grid, const LevelCrossing& crossing);

/// All of them, in the order of nodes and directions; none is nearer to an end than 1/256.
/// \throw as make_level_set()
[[nodiscard]] std::vector<LevelCrossing> level_crossings(const LevelGrid& grid,
                                                         const LevelValues& values,
                                                         const BatchOfValues& function,
                                                         const LevelSetOptions& options);

}  // namespace trisect::detail
