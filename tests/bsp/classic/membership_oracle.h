// SPDX-License-Identifier: Apache-2.0
//
// Point classification by looking at every triangle, the oracle of the tree's answers.
#pragma once

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/bsp_tree.h>

namespace trisect::test {

/// With integers alone, by counting crossings along segments in general position.
/// \pre the mesh bounds a solid; coordinates below 2^18 in absolute value.
[[nodiscard]] BspTree::Membership brute_force_membership(const LatticeMesh& mesh,
                                                         const LatticePoint& p);

}  // namespace trisect::test
