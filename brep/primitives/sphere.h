// SPDX-License-Identifier: Apache-2.0
//
// Spheres: polyhedra with corners on a sphere about the origin.
// Corners are rounded to a grid of less than 1.2e-10 of the radius.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// An icosahedron whose triangles are cut in four `subdivisions` times: 20·4^subdivisions triangles
/// of nearly equal size. \throw UsageError unless the radius is positive and subdivisions <= 10.
[[nodiscard]] PolygonMesh make_icosphere(double radius, std::uint32_t subdivisions = 4);

/// Triangles between circles of latitude: `slices` around the z axis, `stacks` from pole to pole;
/// 2·slices·(stacks - 1) of them.
/// \throw UsageError unless the radius is positive, 3 <= slices <= 65536, 2 <= stacks <= 65536 and
/// there are at most 2^27 triangles.
[[nodiscard]] PolygonMesh make_uv_sphere(double radius, std::uint32_t slices = 64,
                                         std::uint32_t stacks = 32);

}  // namespace trisect
