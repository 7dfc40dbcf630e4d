// SPDX-License-Identifier: Apache-2.0
//
// Prisms: polygons swept along z.
// Sides and caps are exactly planar.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect {

/// The prism over a simple polygon of either orientation between z = 0 and z = height: n + 2 faces.
/// \throw UsageError for fewer than three corners, no area or a height that is not positive.
[[nodiscard]] PolygonMesh make_prism(const Outline& polygon, double height);

/// The prism over a regular polygon about the z axis whose first corner is (radius, 0). Corners are
/// rounded to a grid of less than 1.2e-10 of the radius, so that import is free of loss.
/// \throw UsageError unless 3 <= sides <= 65536 and radius and height are positive.
[[nodiscard]] PolygonMesh make_regular_prism(std::uint32_t sides, double radius, double height);

}  // namespace trisect
