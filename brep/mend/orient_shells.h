// SPDX-License-Identifier: Apache-2.0
//
// Orientation of closed shells by their volumes and their nesting.
#pragma once

#include <vector>

#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Turns all faces of shells over. `turned` as in orient_faces(); the report has the shells that
/// are left. Exact. O(n log n). \throw LimitError for too many pairs of triangles of different
/// shells
void orient_shells(MendingMesh& mesh, InnerShells inner, std::vector<bool>& turned,
                   MendReport& report);

}  // namespace trisect::detail
