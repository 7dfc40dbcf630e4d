// SPDX-License-Identifier: Apache-2.0
//
// Matching of a mesh with an exact boundary by corners.
//
// A result of a boolean is nearly always the exact boundary with its corners rounded. Then no
// search is needed: moving every corner of the mesh to the vertex that it stands for, or to a point
// of the edge or face that it lies in, makes the mesh cover the exact boundary once, and the
// largest move bounds the distance of all that differs.
//
// The proof. Let φ(t) be the triangle t with its corners moved to these places of E. If the φ(t)
// that are assigned to a face of E all lie in its plane and are oriented as it is, and the edges of
// their outlines cancel but for the face's own, then their sum is the face: two chains of a plane
// with the same boundary are the same, and as no triangle counts negative, each lies in the face.
// Flat φ(t) must lie in edges of these. So φ of the mesh winds about a point as E does. While the
// corners move from t to φ(t), all points of the triangle stay within the largest move m of φ(t),
// which is in the boundary of E, and of t. A point that is farther than m from either of them is
// never swept over, and has the same winding number before and after.
//
// Where some triangles lie in no face, or edges of outlines are left, E less φ of the mesh is a
// cycle: these triangles, and in planes of faces the chains that are bounded by these edges. Each
// connected part of it is a cycle of its own and winds only about points of the box around it. So
// outside these boxes, grown by m, the proof holds, and nothing is said about what is inside them.
#pragma once

#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/verify/boundary_places.h>

namespace trisect::detail {

struct GridBox {
    GridPoint low{}, high{};
};

/// In the maximum norm and in lattice units.
struct CornerBound {
    double move = 0;             ///< outside the boxes all that differs is within it of both
    std::vector<GridBox> boxes;  ///< none: everywhere
};

/// Corners that are at most `reach` away from a place move to it. O(n log n).
/// \pre both on the same lattice
[[nodiscard]] CornerBound matched_corners(const Brep& exact, const BoundaryTriangles& surface,
                                          const LatticeMesh& mesh, double reach);

}  // namespace trisect::detail
