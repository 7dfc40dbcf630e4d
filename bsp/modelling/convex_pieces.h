// SPDX-License-Identifier: Apache-2.0
//
// ConvexPieces: operands of Minkowski sums, as point sets whose hulls are convex pieces.
#pragma once

#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

struct ConvexPieces {
    /// The solid itself, if it is convex; else the pieces of its boundary.
    std::vector<std::vector<Point3d>> pieces;
    bool is_convex = false;
    /// A point of each connected part of the boundary.
    std::vector<Point3d> representatives;
};

/// Triangles of the boundary, also of a convex solid.
[[nodiscard]] ConvexPieces pieces_of_boundary(const Solid& solid);
[[nodiscard]] ConvexPieces pieces_of_solid(const Solid& solid, const MinkowskiOptions& options);

}  // namespace trisect::detail
