// SPDX-License-Identifier: Apache-2.0
//
// Solids where a function of space is above a level.
#pragma once

#include <trisect/brep/level_set/level_set_mesh.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The points of the box where the function is above the level, as make_level_set() has them: a
/// boundary that does not touch itself, which is proved and so not looked for. The empty set where
/// no sample is above. \throw as make_level_set()
[[nodiscard]] Solid level_set(const FunctionOfSpace& function, const Bounds& box,
                              double edge_length, const LevelSetOptions& options = {});
[[nodiscard]] Solid level_set_by_batches(const BatchOfValues& function, const Bounds& box,
                                         double edge_length, const LevelSetOptions& options = {});

}  // namespace trisect
