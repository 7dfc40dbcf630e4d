// SPDX-License-Identifier: Apache-2.0
//
// Orientation of faces that are connected over edges of two faces.
#pragma once

#include <vector>

#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Turns loops over. Notes in the report what has no orientation; `turned` has a flag for each face
/// and is changed for those that are turned. O(n).
void orient_faces(MendingMesh& mesh, std::vector<bool>& turned, MendReport& report);

/// Reverses the loop of a face; its first corner stays first.
void turn_face(MendingMesh& mesh, std::size_t face);

}  // namespace trisect::detail
