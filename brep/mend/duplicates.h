// SPDX-License-Identifier: Apache-2.0
//
// Faces with the same corners.
#pragma once

#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Leaves out all but one of the faces with the same corners in the same order. Of what remains,
/// two faces of opposite orientation are both left out where each of their edges has an even number
/// of other faces (a wall), and the second one where it has an odd number; otherwise both stay.
/// Another such pair counts as no face. O(n log n).
void drop_duplicates(MendingMesh& mesh, MendReport& report);

}  // namespace trisect::detail
