// SPDX-License-Identifier: Apache-2.0
//
// Scenes of solids that are nearly equally near to each other all over.
// For them a distance has to tell many pairs of triangles apart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "interference_scene.h"

namespace interference_scenes {

/// The names of these scenes.
[[nodiscard]] std::vector<std::string> clearance_names();

/// - clear:peg: a cylinder of 128 sides in a hole of 128 sides, 1/100 of the radius apart.
/// - clear:plates: two plates, each side in 32 by 32 squares, face to face.
/// - clear:tubes: a tube in a tube, both of 64 rings of 64 corners.
/// - clear:gears: two gears of 24 teeth that mesh without touching.
/// - clear:offset: a bumpy ball in a mould that is the ball, larger by a hundredth.
/// - clear:spheres: a sphere of 20,480 triangles in the middle of one that is larger by a fiftieth.
///
/// A is what is left of a block after a boolean in all but the plates and the gears. A quarter of
/// the placements each is concentric, turned, off the middle, and tilted.
[[nodiscard]] std::optional<Scene> make_clearance(const std::string& name, std::size_t most);

}  // namespace interference_scenes
