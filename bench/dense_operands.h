// SPDX-License-Identifier: Apache-2.0
//
// Families of solids that share most of their volume, some 800 triangles each.
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

}  // namespace bench
