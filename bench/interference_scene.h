// SPDX-License-Identifier: Apache-2.0
//
// Scenes of interference benchmarks: two meshes and placements of the second one, as plain doubles,
// so that every engine sees the same ones.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

#include "interference_peers.h"

namespace interference_scenes {

struct Scene {
    std::string name;
    trisect::PolygonMesh a;
    trisect::PolygonMesh b;
    std::vector<interference_peers::Placement> placements;
    /// A motion: no point moves by more than a hundredth of the diameter from one to the next.
    std::vector<interference_peers::Placement> path;
    /// Where there are any, A is what these leave of `blank`, and `a` is empty until it is made.
    trisect::PolygonMesh blank{};
    std::vector<trisect::PolygonMesh> tools{};
};

/// The names of the scenes that are measured when none is named.
[[nodiscard]] std::vector<std::string> names();

/// - tori, tori200k: two linked tori R = 1, r = 1/4 of 20,000 and 200,978 triangles, the gap
///   between their tubes swinging between +0.05 and -0.01.
/// - FILE (bear28k, bunny100k, or any mesh file): the mesh against itself, 2,000 random rotations,
///   the centres apart by 0.35 to 0.85 of the box's diagonal in a random direction.
/// - clear:NAME: those of clearance_scenes.h.
/// - screw, parts: those of apps/scenes/scenes.h with up to 2,000 placements.
///
/// `most` limits the number of placements. \throw trisect::Error when a file is missing.
[[nodiscard]] Scene make(const std::string& name, std::size_t most);

}  // namespace interference_scenes
