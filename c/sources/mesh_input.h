// SPDX-License-Identifier: Apache-2.0
//
// Meshes from a caller's arrays.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect-c/trisect.h>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/triangle_view.h>
#include <trisect/bsp/solid.h>

namespace trisect::c {

/// The arrays where they are. \throw UsageError for null pointers
[[nodiscard]] TriangleView view_of(const double* vertices, std::size_t vertex_count,
                                   const std::uint32_t* faces, std::size_t face_count);

/// \throw UsageError for null pointers, LimitError for more than 2^32 - 1 corners
[[nodiscard]] PolygonMesh triangles_of(const double* vertices, std::size_t vertex_count,
                                       const std::uint32_t* faces, std::size_t face_count);
/// \throw as above, and UsageError where face_begin decreases
[[nodiscard]] PolygonMesh polygons_of(const double* vertices, std::size_t vertex_count,
                                      const std::uint32_t* corners, const std::uint32_t* face_begin,
                                      std::size_t face_count);

/// \throw UsageError for a wrong size or embedding
[[nodiscard]] SolidOptions options_of(const trisect_solid_options* options);

}  // namespace trisect::c
