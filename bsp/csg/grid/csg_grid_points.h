// SPDX-License-Identifier: Apache-2.0
//
// Corners of shapes on OpenSCAD's grid.
#pragma once

#include <optional>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/transform.h>

namespace trisect::detail {

/// Corners in doubles: products are added up from the first column to the last, each sum rounded.
[[nodiscard]] PolygonMesh moved_in_doubles(const PolygonMesh& mesh, const AffineMap& map);

/// Cut off to multiples of 2^-20, face by face. A corner in a cell beside one that is taken, also
/// across edges and corners of cells, goes there: to the nearest, and of equal ones to the first in
/// the order of x, y, z. Corners that follow each other and are one then are left once, and faces
/// with less than three are left out. Nothing where a coordinate has no number of a cell.
[[nodiscard]] std::optional<PolygonMesh> on_openscad_grid(const PolygonMesh& mesh);

/// Whether it is closed, in one piece, and no edge is a valley of more than a tenth of a degree.
/// Faces are divided from their first corner.
[[nodiscard]] bool is_about_convex(const PolygonMesh& mesh);

}  // namespace trisect::detail
