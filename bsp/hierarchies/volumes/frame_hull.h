// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of points in the units of a TreeFrame.
// They are exact for the points rounded to a grid.
#pragma once

#include <span>

#include <trisect/bsp/hierarchies/convex/convex_polytope.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>

namespace trisect::hierarchies {

/// One unit of the polytope's coordinates, in units of the frame.
inline constexpr double frame_hull_unit = 0x1p-24;

/// The hull of the points, each coordinate rounded to the nearest multiple of frame_hull_unit.
/// \pre |x_k| <= 4
[[nodiscard]] ConvexPolytope frame_hull(std::span<const detail::Vector3> points);

/// Moments of the hull's surface.
[[nodiscard]] detail::AreaMoments surface_moments(const ConvexPolytope& hull);

}  // namespace trisect::hierarchies
