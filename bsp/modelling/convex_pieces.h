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
    /// The solid itself, if it is convex; else convex parts of the side, as far as the boundary is
    /// embedded, which hold all of the boundary, or its triangles.
    std::vector<std::vector<Point3d>> pieces;
    bool is_convex = false;
    /// Whether the pieces are all of the solid.
    bool fills = false;
    /// A point of each connected part of the boundary.
    std::vector<Point3d> representatives;
};

/// Parts that are not within the solid, also of a convex one.
[[nodiscard]] ConvexPieces pieces_around(const Solid& solid);
[[nodiscard]] ConvexPieces pieces_of_solid(const Solid& solid, const MinkowskiOptions& options);

}  // namespace trisect::detail
