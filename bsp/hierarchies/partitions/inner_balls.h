// SPDX-License-Identifier: Apache-2.0
//
// InnerBall: a ball within a convex region, updated plane by plane.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/interference/boxes/approximate_map.h>

namespace trisect::hierarchies {

/// All points nearer to the centre than the radius, in lattice units; never empty.
struct InnerBall {
    std::array<double, 3> center{};
    double radius = 0;
};

/// A plane as doubles: of the true one every coefficient is within 2^-50 of its magnitude of what
/// is given.
struct RoughPlane {
    std::array<double, 3> normal{};
    double offset = 0;
};

/// A ball within this ball whose points are all certainly below the plane (n·x + d < 0), or above
/// it: the largest, nearly. Nothing where that would be smaller than what roundings hide.
[[nodiscard]] std::optional<InnerBall> part_below(const InnerBall& ball, const RoughPlane& plane);
[[nodiscard]] std::optional<InnerBall> part_above(const InnerBall& ball, const RoughPlane& plane);

/// A lower bound of how far a point is below a plane; negative where it may be above.
[[nodiscard]] double depth_below(const std::array<double, 3>& p, const RoughPlane& plane);

/// A lower bound of the length of an image over that of the vector; 0 for maps that are far from
/// similarities.
[[nodiscard]] double least_stretch(const detail::ApproximateMap& map);

}  // namespace trisect::hierarchies
