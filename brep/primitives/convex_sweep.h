// SPDX-License-Identifier: Apache-2.0
//
// Convex meshes: hulls of lattice points, and sweeps along vectors.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect {

/// The convex hull of the points, exact, as triangles; coplanar ones are of one face, which they
/// divide into a strip. Its points are the corners of the hull. Expected O(n log n), at worst
/// O(n f) for f triangles of the hull; half a second for 100,000 points on a sphere.
/// \throw UsageError when all points lie in one plane; CancelledError, LimitError of StopScope.
[[nodiscard]] LatticeMesh hull_mesh(std::span<const LatticePoint> points, Lattice lattice);

/// Whether no point of the mesh is above the plane of a triangle; exact. For a closed mesh of one
/// shell this says that it is convex. O(n f).
[[nodiscard]] bool is_convex(const LatticeMesh& mesh);

/// What a convex solid meets on a straight way: the union of all its copies moved by s times the
/// vector, s from 0 to 1, exactly. `by` is in units of the mesh's lattice. The result is closed and
/// embedded: triangles that look along the vector, moved, those that look back, where they were,
/// and two over each edge between. Triangles parallel to the vector count as the first kind, so
/// whatever lies in their plane is swept in it and nothing is there twice. Faces of the mesh keep
/// their numbers; that over an edge has a larger one. O(n log n).
/// \pre the mesh is closed, of one shell and convex: it is not checked
/// \throw LimitError when a moved coordinate is no double or leaves the lattice's range
[[nodiscard]] LatticeMesh swept(const LatticeMesh& convex, const std::array<double, 3>& by);

/// The hull of all triangles of a convex mesh that look along the vector. What a body meets on its
/// way beyond where it stands, swept(convex, by) less convex, is met by this part of it, which has
/// about half the triangles. Triangles parallel to the vector do not count. The mesh itself where
/// all of these lie in one plane. Takes what hull_mesh takes.
/// \pre as swept(); the vector is not zero
[[nodiscard]] LatticeMesh leading_part(const LatticeMesh& convex, const std::array<double, 3>& by);

/// Which triangles look along the vector: a key for leading_part, which is the same for the same.
/// \throw LimitError as swept()
[[nodiscard]] std::vector<bool> leading_triangles(const LatticeMesh& convex,
                                                  const std::array<double, 3>& by);

/// The mesh moved, exactly; all else stays. \throw LimitError as above
[[nodiscard]] LatticeMesh moved(const LatticeMesh& mesh, const std::array<double, 3>& by);

}  // namespace trisect
