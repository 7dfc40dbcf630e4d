// SPDX-License-Identifier: Apache-2.0
//
// Polygons in the plane: triangles, and the regions of solids' sections.
#pragma once

#include <optional>
#include <vector>

#include <manifold/common.h>
#include <trisect/bsp/solid.h>

#include "tri_mesh.h"

namespace manifold {

/// Triangles of the corners, numbered one polygon after the other. Nothing where polygons cross.
[[nodiscard]] std::optional<std::vector<Triple>> triangulated(const Polygons& polygons);
/// The prism of height 1 over all points about which the polygons wind a positive number of times.
[[nodiscard]] trisect::Solid prism_over(const Polygons& polygons);
/// The prism of height 1 over all points about which the polygons wind an odd number of times.
[[nodiscard]] trisect::Solid prism_by_parity(const Polygons& polygons);
/// The region of a section, its outline first.
[[nodiscard]] std::vector<Polygons> regions_of(const trisect::Solid& solid, double height);
/// Outlines and holes of the section at a height.
[[nodiscard]] Polygons section_of(const trisect::Solid& solid, double height);

}  // namespace manifold
