// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers along straight segments, for lists of polygons.
// Signs come from trace.h.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/trace/trace.h>

namespace trisect::detail {

/// Change of an operand's winding number from one reference point to another, along polygons that
/// include all that meet the segment. Nothing when the segment is degenerate.
[[nodiscard]] std::optional<int> trace_winding(std::span<const PolygonRef> polygons, bool flipped,
                                               const FinePoint& from, const FinePoint& to);

/// Box of a segment in lattice units, rounded outwards.
[[nodiscard]] Box box_of_segment(const Approximation& a, const Approximation& b);

/// A segment with an end in the plane of a polygon. The reference lies on no polygon, so if it is
/// the reference's end there is no crossing. If it is the target's, or the whole segment lies in
/// the plane, the segment avoids the polygon when all of it is beyond one edge; otherwise nothing
/// is claimed. `..._outside(edge)` states whether that end is strictly beyond the edge.
template <class Edges, class ReferenceOutside, class TargetOutside>
bool avoids_in_plane(int at_reference, int at_target, const Edges& edges,
                     const ReferenceOutside& reference_outside,
                     const TargetOutside& target_outside) {
    if (at_target != 0) return true;
    return std::any_of(edges.begin(), edges.end(), [&](const auto& e) {
        return target_outside(e) && (at_reference != 0 || reference_outside(e));
    });
}

}  // namespace trisect::detail
