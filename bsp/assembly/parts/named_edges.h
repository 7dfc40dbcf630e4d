// SPDX-License-Identifier: Apache-2.0
//
// Edges of sources as intersections of named planes.
#pragma once

#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// Whether a plane surely passes through a point because an edge of a source lies in it: the edge
/// that two planes of the point have in common, or one that crosses that. No plane is made, and
/// crossings are decided in 128 bits. False says nothing. \pre three planes name the point.
[[nodiscard]] bool passes_by_edges(const Workbench& bench, PointId point, PlaneId plane);

}  // namespace trisect::detail
