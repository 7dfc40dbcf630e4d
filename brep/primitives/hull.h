// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of points.
#pragma once

#include <span>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The convex hull, exact, as triangles whose corners are points that were given, as they are.
/// Points within the hull, its faces and its edges are left out. O(n f) for f triangles of the
/// hull: a second for ten thousand points on a sphere.
/// \throw UsageError when all points lie in one plane; LimitError for coordinates that are not
/// finite or span more than 126 bits.
[[nodiscard]] PolygonMesh make_hull(std::span<const Point3d> points);

}  // namespace trisect
