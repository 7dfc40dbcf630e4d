// SPDX-License-Identifier: Apache-2.0
//
// From the directed boundary edges of a planar region to faces: an outer loop and its holes.
#pragma once

#include <span>
#include <vector>

#include <trisect/bsp/detail/assembly_parts.h>

namespace trisect::detail {

/// loops[0] is the outer loop; points in order, the region to the left seen from outside.
struct FaceLoops {
    std::vector<std::vector<PointId>> loops;
};

/// The faces of the region that `edges` bound. All edges lie in the plane of `support`, whose
/// outward normal is that plane's, or its opposite when `flipped`; the region is to the left of
/// every edge. At a vertex where the region touches itself every wedge of it keeps its own pair of
/// edges. Deterministic: loops start at their lexicographically smallest vertex by order of the
/// edges given. \throw Error Internal when the edges do not form closed loops.
[[nodiscard]] std::vector<FaceLoops> make_face_loops(const Workbench& bench, PlaneId support,
                                                     bool flipped,
                                                     std::span<const BoundaryEdge> edges);

}  // namespace trisect::detail
