// SPDX-License-Identifier: Apache-2.0
//
// LevelValues: a function at the nodes of a grid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/level_set/level_grid.h>
#include <trisect/brep/level_set/level_set_mesh.h>

namespace trisect::detail {

/// Calls the function for places one after the other, some thousand at once, and takes the level
/// from its values. \throw UsageError that names the place of a value that is not finite
void values_at(const BatchOfValues& function, const LevelSetOptions& options,
               std::span<const Point3d> places, std::span<double> values);

class LevelValues {
public:
    /// \throw as make_level_set()
    LevelValues(const LevelGrid& grid, const BatchOfValues& function,
                const LevelSetOptions& options);

    [[nodiscard]] double operator[](std::size_t node) const { return values_[node]; }
    /// 1 where the function is above the level, else -1; anything for numbers of no node.
    [[nodiscard]] std::vector<std::int8_t> signs() const;

private:
    std::vector<double> values_;
};

}  // namespace trisect::detail
