// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of points.
#pragma once

#include <span>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The convex hull, exact, as triangles whose corners are points that were given, as they are.
/// Points within the hull, its faces and its edges are left out. Expected O(n log n), at worst
/// O(n f) for f triangles of the hull; half a second for 100,000 points on a sphere. Stops as
/// StopScope says.
/// \throw UsageError when all points lie in one plane; LimitError for coordinates that are not
/// finite or span more than 126 bits; CancelledError.
[[nodiscard]] PolygonMesh make_hull(std::span<const Point3d> points);

}  // namespace trisect
