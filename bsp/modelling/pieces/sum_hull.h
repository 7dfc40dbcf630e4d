// SPDX-License-Identifier: Apache-2.0
//
// Hulls of the sums of two point sets.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// The hull of all sums of two corners, which are rounded where they are no doubles. Nothing when
/// it is flat.
[[nodiscard]] std::optional<PolygonMesh> sum_hull(std::span<const Point3d> a,
                                                  std::span<const Point3d> b);

}  // namespace trisect::detail
