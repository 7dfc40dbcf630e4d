// SPDX-License-Identifier: Apache-2.0
//
// Tori.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// A torus about the z axis in triangles, 2·major_segments·minor_segments of them. Corners are
/// rounded to a grid of less than 1.2e-10 of the outer radius.
/// \throw UsageError unless 0 < minor_radius < major_radius, both numbers of segments are between 3
/// and 65536, and there are at most 2^27 triangles.
[[nodiscard]] PolygonMesh make_torus(double major_radius, double minor_radius,
                                     std::uint32_t major_segments = 64,
                                     std::uint32_t minor_segments = 32);

}  // namespace trisect
