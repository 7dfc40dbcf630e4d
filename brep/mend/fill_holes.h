// SPDX-License-Identifier: Apache-2.0
//
// Faces for holes that are one planar loop.
#pragma once

#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Adds a face, or triangles where the mesh has no other faces, for each loop of open edges that
/// meets no other and is simple and planar, exactly. Turned against the face of its first edge.
/// O(n log n).
void fill_planar_holes(MendingMesh& mesh, MendReport& report);

}  // namespace trisect::detail
