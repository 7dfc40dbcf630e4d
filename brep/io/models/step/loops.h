// SPDX-License-Identifier: Apache-2.0
//
// Polygons that fill a face of several loops.
#pragma once

#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/point3d.h>

#include <optional>
#include <span>
#include <vector>

namespace trisect::detail {

/// Twice the area of a loop, as a vector, in doubles.
[[nodiscard]] Point3d area_vector(std::span<const Point3d> points, const IndexLoop& loop);

/// One polygon with bridges, or triangles where loops touch or fall into pieces. Exact in the
/// projection along the largest component of the loops' area vector, so corners need not lie in one
/// plane. Corners at the same place become one. Nothing when the loops bound no region or have no
/// area.
/// \throw LimitError for coordinates that span too many bits
[[nodiscard]] std::optional<std::vector<IndexLoop>> polygons_of_loops(
    std::span<const Point3d> points, const std::vector<IndexLoop>& loops);

}  // namespace trisect::detail
