// SPDX-License-Identifier: Apache-2.0
//
// Division of a polygon of a leaf along another polygon.
#pragma once

#include <array>

#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// Does the line `line` ∩ support, restricted to the convex polygon `cutter`, run through the
/// interior of the piece? A cutter that ends along that line counts as if it went on.
/// \pre both polygons have their edges; `line` is not the piece's support.
/// `ends`: of the common segment, or of part of the line that contains it.
[[nodiscard]] bool segment_meets_interior(Workbench& bench, const WorkPolygon& piece, PlaneId line,
                                          const WorkPolygon& cutter, std::array<PointId, 2>& ends);

/// Splits a piece along a line if the cutter runs through its interior there: `piece` is then the
/// part below and `above` the other one. False when nothing was split. `sure`: it does. `along`, if
/// not null: set to the plane of an edge of the piece that lies on `line`, if there is one and
/// nothing was split.
bool split_along(Workbench& bench, WorkPolygon& piece, PlaneId line, const WorkPolygon& cutter,
                 bool sure, WorkPolygon& above, PlaneId* along = nullptr);

/// Whether three planes have a line in common: `cutter`, the support of a piece, and the support of
/// another facet along which the piece was cut, `edge`, the plane of an edge that lies in `cutter`
/// too. \pre `own`, the edges of the polygon that the piece is part of, are no such cuts.
[[nodiscard]] bool is_common_line(const Workbench& bench, const Few<WorkEdge>& own, PlaneId edge,
                                  PlaneId cutter);

}  // namespace trisect::detail
