// SPDX-License-Identifier: Apache-2.0
//
// Scenes for the search for cliffs: families of shapes, sizes and placements, by name.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace bench {

/// Of the words of a name cliff:SHAPE:TRIANGLES:PLACEMENT, a pair of solids,
///
///     SHAPE      sphere globe torus cylinder cone prism star block rough needle disc rod plate
///                spikes terrain comb, or the path of a model with slashes
///     TRIANGLES  about so many in each; of a model the number is 0
///     PLACEMENT  general axis self ulp mirror turn90 turn180 turned turnedself small tiny flush
///                edge corner inside apart, of the second operand beside the first
///
/// or cliff:GROUP:SHAPE:N:TRIANGLES, many solids,
///
///     GROUP      swarm (turned at random, in one place) onion (one within the other) row (each
///                meets the next) ring (turned about an axis) grid (apart) tiles (flush) cloud (at
///                random, half of the space) tools (a block less the others)
///
/// for scripts/cliffs. \throw UsageError for an unknown name
[[nodiscard]] Scene cliff_scene(const std::vector<std::string>& words);

}  // namespace bench
