// SPDX-License-Identifier: Apache-2.0
//
// Meshes of prisms over regions of the plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/cells/flat/flat_region.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// Loops of a resolved region, of its vertices; the inside is on their left.
[[nodiscard]] std::vector<IndexLoop> flat_loops(const FlatRegion& region);

/// Connected pieces of a resolved region by numbers of its loops: outline, holes.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> flat_regions(const FlatRegion& region);

/// Triangles of a resolved region, over its vertices, counter-clockwise.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> flat_triangles(const FlatRegion& region);

/// Vertices in the user's units, rounded correctly.
[[nodiscard]] std::vector<std::array<double, 2>> flat_coordinates(const FlatRegion& region);

/// Two triangles for each wall. All vertices are corners of caps.
[[nodiscard]] PolygonMesh flat_mesh(const FlatPrism& prism);

}  // namespace trisect::detail
