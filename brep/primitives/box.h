// SPDX-License-Identifier: Apache-2.0
//
// Boxes: six quadrilaterals with the coordinates given, nothing rounded.
#pragma once

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// The box between two corners: 8 points, 6 faces, outward.
/// \throw UsageError unless low < high in every coordinate and all are finite.
[[nodiscard]] PolygonMesh make_box(const Point3d& low, const Point3d& high);
/// The box of this size with one corner at the origin.
[[nodiscard]] PolygonMesh make_box(const Point3d& size);

}  // namespace trisect
