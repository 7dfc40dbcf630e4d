// SPDX-License-Identifier: Apache-2.0
//
// Families of many solids, most of which share most of their volume.
// Where nothing else is said they have some 800 triangles each.
#pragma once

#include <cstddef>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace bench {

/// Bumpy spheres about one centre, each turned at random, with radii that differ by up to a
/// hundredth: all boundaries cross all others, everywhere.
[[nodiscard]] std::vector<trisect::PolygonMesh> nearly_equal_solids(std::size_t n);

/// Spheres about one centre, each turned at random, with radii from 1/2 to 1: no two boundaries
/// meet as long as there are fewer than some 32.
[[nodiscard]] std::vector<trisect::PolygonMesh> nested_solids(std::size_t n);

/// Bumpy spheres with centres at random in a ball of a third of their radius.
[[nodiscard]] std::vector<trisect::PolygonMesh> solids_in_one_place(std::size_t n);

/// Cylinders of 200 sides about one centre, each turned at random: long thin triangles, and boxes
/// of nearly all pairs overlap.
[[nodiscard]] std::vector<trisect::PolygonMesh> turned_cylinders(std::size_t n);

/// A plate of 1,200 triangles, and capsules along a path in it, each a fifth of its radius beyond
/// the one before.
[[nodiscard]] std::vector<trisect::PolygonMesh> plate_and_path(std::size_t n);

/// A bumpy sphere, moved along x by a thirty-second of its radius each time: edges meet edges.
[[nodiscard]] std::vector<trisect::PolygonMesh> copies_along_axis(std::size_t n);

/// Prisms of 200 sides on one floor about one axis, wide and low to narrow and high.
[[nodiscard]] std::vector<trisect::PolygonMesh> prisms_on_floor(std::size_t n);

/// The same prism of 200 sides, each on top of the one before.
[[nodiscard]] std::vector<trisect::PolygonMesh> stacked_prisms(std::size_t n);

/// A plate of 1,200 triangles, and cylinders of 100 sides from its middle, flush with its upper
/// side, apart from each other; `through`: to its lower side.
[[nodiscard]] std::vector<trisect::PolygonMesh> plate_and_drills(std::size_t n, bool through);

/// The same plate, and cylinders of 100 sides along x, each an eighth of its radius beyond the one
/// before, from one depth to its upper side.
[[nodiscard]] std::vector<trisect::PolygonMesh> plate_and_slot(std::size_t n);

}  // namespace bench
