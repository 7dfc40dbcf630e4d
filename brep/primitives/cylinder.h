// SPDX-License-Identifier: Apache-2.0
//
// Cylinders: regular prisms with many sides.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// A cylinder about the z axis between z = 0 and z = height; its corners lie on the circle, its
/// sides inside it. All faces are exactly planar: `segments` quadrilaterals and two polygons.
/// \throw UsageError unless 3 <= segments <= 65536 and radius and height are positive.
[[nodiscard]] PolygonMesh make_cylinder(double radius, double height, std::uint32_t segments = 64);

}  // namespace trisect
