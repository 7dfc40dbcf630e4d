// SPDX-License-Identifier: Apache-2.0
//
// Division of open edges by vertices that lie on them, or near.
#pragma once

#include <trisect/brep/mend/exact_distance.h>
#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// Puts vertices that lie exactly inside of edges whose uses do not cancel, and are ends of such
/// edges, into all of these. What the faces cover stays the same. Those that are within `ends` of
/// an end stay out: they are to be joined with it. O(n log n) for n such edges of which few meet.
/// \throw LimitError for many
void divide_exactly(MendingMesh& mesh, const DistanceBound& ends, Lattice lattice,
                    MendReport& report);

/// Puts each end of an open edge that lies within the distance of others, and beside the inside of
/// them, into the nearest one, unless a face of it has the vertex. Divided faces are cut into
/// triangles where they are not planar, or were triangles. As above.
void divide_near(MendingMesh& mesh, const DistanceBound& bound, Lattice lattice,
                 MendReport& report);

/// Leaves out faces whose corners are on one line, and notes them. A corner that a loop names twice
/// in succession stays once.
void leave_out_degenerate(MendingMesh& mesh, MendReport& report);

}  // namespace trisect::detail
