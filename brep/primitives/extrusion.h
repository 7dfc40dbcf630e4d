// SPDX-License-Identifier: Apache-2.0
//
// Extrusions: an outline with holes, swept along z.
#pragma once

#include <span>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect {

/// The solid between z = low and z = high over the inside of `outer` minus the insides of `holes`.
/// Sides are quadrilaterals; caps are one polygon each, or triangles where there are holes.
/// Coordinates are taken as they are. Outlines may have either orientation; they must be simple,
/// holes inside the outer one and apart from each other. Holes that cross or touch anything
/// are refused where the caps cannot be cut, and found by validate() otherwise.
/// O(n) without holes, O(n²) at worst with them.
/// \throw UsageError for fewer than three corners, no area, low >= high, or caps that cannot be
/// cut.
[[nodiscard]] PolygonMesh make_extrusion(const Outline& outer, std::span<const Outline> holes,
                                         double low, double high);

}  // namespace trisect
