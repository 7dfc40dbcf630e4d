// SPDX-License-Identifier: Apache-2.0
//
// bsp_boolean: a boolean operation on two meshes through BspTrees.
#pragma once

#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/boolean_rule.h>
#include <trisect/kernel/convex_polygon.h>

namespace trisect {

/// Builds both trees, merges them and returns the result's boundary (see boundary_of).
/// \pre both meshes bound solids as build_bsp demands.
/// \throw UsageError when the meshes are on different lattices.
[[nodiscard]] std::vector<ConvexPolygon> bsp_boolean(BooleanRule rule, const LatticeMesh& a,
                                                     const LatticeMesh& b);

}  // namespace trisect
