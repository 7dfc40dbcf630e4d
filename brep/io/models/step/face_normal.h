// SPDX-License-Identifier: Apache-2.0
//
// Unit normal of a polygon, right to the last digits.
#pragma once

#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/point3d.h>

#include <optional>
#include <span>

namespace trisect::detail {

/// Of the polygon's area vector, each component off by about 1e-13 at most: by doubles where little
/// cancels, or else by fractions. Nothing when the area is zero.
[[nodiscard]] std::optional<Point3d> face_normal(std::span<const Point3d> points,
                                                 std::span<const std::uint32_t> polygon);

/// The largest distance of a corner from the plane through the first one.
[[nodiscard]] double distance_from_plane(std::span<const Point3d> points,
                                         std::span<const std::uint32_t> polygon,
                                         const Point3d& normal);

}  // namespace trisect::detail
