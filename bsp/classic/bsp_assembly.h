// SPDX-License-Identifier: Apache-2.0
//
// brep_from_fragments: a Brep with maximal faces from convex fragments.
// It is the second, simple assembly of the project: its input is the fragments alone, not their
// origin.
#pragma once

#include <span>

#include <trisect/brep/brep.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/lattice.h>

namespace trisect {

/// Joins fragments to faces: a face is a maximal connected open region of fragments with the same
/// plane and orientation. Regions that touch in vertices only are faces of their own. A vertex is
/// kept where the faces around it turn; everything that only cutting left behind disappears, so the
/// result depends on the set alone, up to numbering.
///
/// \pre the fragments are closed and oriented outward and overlap nowhere (boundary_of provides
/// them); T-vertices are resolved here. Face i has the source {0, i}: fragments carry no
/// provenance. Cost: O(f·p + e·v) filtered comparisons for f fragments on p planes, with e edges
/// and v vertices. \throw Error (InvalidSolid) when the fragments are not closed.
[[nodiscard]] Brep brep_from_fragments(std::span<const ConvexPolygon> fragments, Lattice lattice);

}  // namespace trisect
