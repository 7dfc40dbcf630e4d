// SPDX-License-Identifier: Apache-2.0
//
// Boundary of a BspTree as convex fragments, and its exact volume.
#pragma once

#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/bsp_tree.h>
#include <trisect/kernel/convex_polygon.h>

namespace trisect {

/// The boundary of the set, oriented outward, as convex polygons that overlap nowhere and together
/// cover it exactly. Regularised: a piece is there because it separates an In cell from an Out
/// cell. The faces of the cube that bounds space are never part of it. Neighbours may meet in
/// T-vertices, and coplanar neighbours are not joined (see brep_from_fragments). Cost: every
/// section is pushed through the subtrees that touch it.
[[nodiscard]] std::vector<ConvexPolygon> boundary_of(const BspTree& tree);

/// The volume enclosed by a closed boundary in lattice units cubed, negative when it is oriented
/// inward. The numbers grow with the number of different cut vertices: for models of tests.
[[nodiscard]] ExactRational enclosed_volume(std::span<const ConvexPolygon> boundary);

}  // namespace trisect
