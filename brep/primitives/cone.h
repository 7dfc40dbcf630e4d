// SPDX-License-Identifier: Apache-2.0
//
// Cones and frustums.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// A cone about the z axis with the bottom circle at z = 0 and the top one at z = height. One of
/// the radii may be 0: there is an apex. Sides are triangles, because rounded corners of a
/// frustum's side do not lie in one plane; caps are polygons. \throw UsageError unless 3 <=
/// segments <= 65536, the height is positive and the radii are not negative and not both 0.
[[nodiscard]] PolygonMesh make_cone(double bottom_radius, double top_radius, double height,
                                    std::uint32_t segments = 64);

}  // namespace trisect
