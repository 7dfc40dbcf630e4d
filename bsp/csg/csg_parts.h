// SPDX-License-Identifier: Apache-2.0
//
// Meshes whose parts touch in edges and corners.
#pragma once

#include <optional>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// The union of the parts of a mesh of triangles that hang together by edges of two triangles, each
/// without self-intersection: an operand for each, where the mesh as one would meet itself. Nothing
/// where it has one part, and where one of them meets itself or is inside out. O(n log n)
[[nodiscard]] std::optional<Expression> union_of_parts(const PolygonMesh& mesh);

}  // namespace trisect::detail
