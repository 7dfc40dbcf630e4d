// SPDX-License-Identifier: Apache-2.0
//
// Mesh of an exact boundary with a polygon for each face.
#pragma once

#include <trisect/brep/brep_mesh.h>

namespace trisect {

/// As to_polygon_mesh() without triangles, but that a face with holes is one polygon, too
/// (joined_loops.h). Where its loops touch in two copies of a vertex it becomes triangles.
[[nodiscard]] PolygonMesh whole_face_mesh(const Brep& brep, MeshMap* map = nullptr);

}  // namespace trisect
