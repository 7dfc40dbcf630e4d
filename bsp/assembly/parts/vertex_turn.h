// SPDX-License-Identifier: Apache-2.0
//
// Turns of outlines at their vertices, from planes alone.
// Where an edge of a nearly flat crease pierces a facet, three vertices are almost collinear, and
// points would have to be evaluated.
#pragma once

#include <array>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// The turn from edge `in` to edge `out`, which leaves the vertex that `in` ends at, seen from
/// outside: 1 to the left, -1 to the right, 0 where both lie on one line, straight on or back.
/// Exact, of degree 3 in the planes, and no point is looked at. \pre both bound a region in the
/// plane of `support`, whose outward normal is that plane's, or its opposite when `flipped`.
[[nodiscard]] int turn_at_vertex(const Workbench& bench, PlaneId support, bool flipped,
                                 const WorkEdge& in, const WorkEdge& out);

/// Whether the name of the vertex says that two edges of a region in the plane of `support` turn
/// there: the planes that name a point meet in nothing else, so no two of them meet the third one
/// in one line. False says nothing.
[[nodiscard]] inline bool name_tells_turn(const Workbench& bench, PointId vertex, PlaneId support,
                                          const WorkEdge& in, const WorkEdge& out) {
    const std::array<PlaneId, 3>& planes = bench.planes_of(vertex);
    const auto is_one = [&](PlaneId plane) {
        return plane == planes[0] || plane == planes[1] || plane == planes[2];
    };
    return in.plane != out.plane && is_one(support) && is_one(in.plane) && is_one(out.plane);
}

}  // namespace trisect::detail
