// SPDX-License-Identifier: Apache-2.0
//
// Joining of vertices on open edges that are near each other.
#pragma once

#include <trisect/brep/mend/exact_distance.h>
#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Renames corners. Nearest pairs first, equal ones by the indices of their vertices; a vertex
/// stays within the distance of where it was, and two vertices of one face stay apart. O(n log n)
/// for n vertices on open edges, of which few lie within the distance of each. \throw LimitError
/// for many
void join_near_vertices(MendingMesh& mesh, const DistanceBound& bound, Lattice lattice,
                        MendReport& report);

}  // namespace trisect::detail
