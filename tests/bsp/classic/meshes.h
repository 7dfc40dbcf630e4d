// SPDX-License-Identifier: Apache-2.0
//
// Meshes for the tests of the classic tree.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/lattice_mesh.h>

namespace trisect::test {

[[nodiscard]] LatticeMesh box(LatticePoint lo, LatticePoint hi);
/// Turned outward whatever the order of the corners. \pre not flat.
[[nodiscard]] LatticeMesh tetrahedron(const LatticePoint& a, const LatticePoint& b,
                                      const LatticePoint& c, const LatticePoint& d);
/// `segments` meridians and `rings` circles between the poles, rounded to the lattice:
/// 2 · segments · rings triangles.
[[nodiscard]] LatticeMesh sphere(LatticePoint centre, double radius, int segments, int rings);

/// Both meshes' triangles in one mesh.
[[nodiscard]] LatticeMesh joined(const LatticeMesh& a, const LatticeMesh& b);
[[nodiscard]] LatticeMesh turned_inside_out(LatticeMesh mesh);

/// Uniform corners in [0, size]³.
[[nodiscard]] LatticeMesh random_tetrahedron(std::mt19937& random, int size);
[[nodiscard]] LatticeMesh random_box(std::mt19937& random, int size);

/// Exact, from the corners.
[[nodiscard]] ExactRational volume(const LatticeMesh& mesh);

}  // namespace trisect::test
