// SPDX-License-Identifier: Apache-2.0
//
// Scenes for the comparison of structures.
// Meshes and placements are plain doubles, so that every engine gets the same ones. All are the
// same with every compiler, and random ones come from seeds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/pose.h>

namespace scenes {

/// A 3x4 matrix, row by row.
using Rows = std::array<double, 12>;

/// Two solids, of which B moves. Corners of both are on one lattice.
struct PairScene {
    std::string name;
    std::string about;  ///< a line for tables
    trisect::PolygonMesh a;
    trisect::PolygonMesh b;
    std::vector<Rows> frames;  ///< poses of B
};

enum class Size : std::uint8_t {
    Small,  ///< for tests: some hundred triangles, some frames
    Full
};

/// - tori-linked: RAPID's sample (repaired): R = 1, r = 1/5, B through the hole of A, turning.
/// - tori-near: the same with the tubes 10^-1 to 10^-6 apart.
/// - tori-crossing: the same, pushed through each other.
/// - shells: a torus within a slightly thicker one, 1/10 to 1/1000 of the tube apart: parallel
///   surfaces close to each other everywhere.
/// - falling: a bent torus falls and tumbles through a knobby one.
/// - screw: a nut goes down its screw, shaken. From TRISECT_MODELS.
/// - parts: two machined parts at ten distances, from 0 by quarter turns to a diameter, and inside
///   of each other. From TRISECT_MODELS.
/// - fly-through: a small body on a path through a field of obstacles, which are one solid.
[[nodiscard]] std::vector<std::string> pair_scene_names();

/// With that many frames, or as many as the scene is made for. Nothing when its models are not
/// there. \throw trisect::UsageError for a name that is none, trisect::Error for a model that
/// cannot be read.
[[nodiscard]] std::optional<PairScene> make_pair_scene(const std::string& name, Size size,
                                                       std::uint32_t frames = 0);

/// The fly-through with side^3 obstacles, equally dense whatever their number.
[[nodiscard]] PairScene make_fly_through(int side, std::uint32_t frames);

/// Many bodies.
struct SwarmScene {
    std::string name;
    std::string about;
    std::vector<trisect::PolygonMesh> shapes;
    std::vector<std::size_t> shape_of;      ///< of each body
    std::vector<std::vector<Rows>> frames;  ///< poses of all bodies, frame by frame
};

/// - convex: 1,000 convex polytopes of 26 faces (92 triangles, 48 corners; cubes cut at corners and
///   edges) of similar size, flying about in a box and turning.
/// - giants: a giant plate, two giant rods and 600 dwarfs of 1/100 of their size.
/// - chain: 400 links, each overlapping the next, that coil into a helix of some turns.
[[nodiscard]] std::vector<std::string> swarm_scene_names();
/// \throw trisect::UsageError
[[nodiscard]] SwarmScene make_swarm_scene(const std::string& name, Size size);

/// The solid with corners (±x, ±y, ±z) for all six orders of 1, 2, 3 times the factors: convex,
/// with integer corners and exactly plane faces of 4, 6 and 8 corners where factors are integers.
[[nodiscard]] trisect::PolygonMesh cut_cube(const std::array<int, 3>& factors);

[[nodiscard]] inline trisect::Pose pose_of(const Rows& rows) {
    return trisect::Pose::from_doubles(rows);
}

}  // namespace scenes
