// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls in the plane.
#pragma once

#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect {

/// Counter-clockwise, without corners on its sides; exact. Fewer than three corners where all
/// points lie on a line. O(n log n).
[[nodiscard]] Outline hull_of_points(std::vector<Point2d> points);

}  // namespace trisect
