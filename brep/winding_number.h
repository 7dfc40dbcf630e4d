// SPDX-License-Identifier: Apache-2.0
//
// Winding number of a triangle mesh about a rational point.
// It is the definition of "inside", evaluated without a tree. Certificates are checked with it:
// slow, short, and independent of everything that finds them.
#pragma once

#include <array>
#include <optional>

#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/lattice_mesh.h>

namespace trisect {

/// How often the triangles wind around the point, counter-clockwise seen from outside counting 1;
/// nothing when the point lies on a triangle. Exact. The mesh may intersect and overlap itself. For
/// a mesh that is not closed the answer is the crossing number of the ray towards +x. O(n), about 5
/// ns for a triangle that the ray passes by.
[[nodiscard]] std::optional<int> winding_number(const LatticeMesh& mesh, const ExactPoint& point);

}  // namespace trisect
