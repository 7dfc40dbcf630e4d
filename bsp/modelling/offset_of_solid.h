// SPDX-License-Identifier: Apache-2.0
//
// Offsets of solids: grown or shrunk by a distance.
#pragma once

#include <cstdint>

#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct SolidOffsetOptions {
    /// What the distance is.
    enum class Shape : std::uint8_t {
        Ball,       ///< that of a ball, which a polyhedron stands for
        Cube,       ///< the largest difference of a coordinate: corners stay sharp
        Octahedron  ///< the sum of the differences of coordinates
    } shape = Shape::Ball;
    /// The polyhedron is make_icosphere() with so many, 3 at most.
    std::uint32_t subdivisions = 1;
    /// Whether it is within the ball, with its corners on the sphere, or around it.
    enum class Fit : std::uint8_t { Within, Around } fit = Fit::Within;
    MinkowskiOptions minkowski = {};
};

/// The radius of the largest ball within the icosphere of radius 1, rounded down: 0.79, 0.93, 0.98
/// and 0.995 for 0 to 3 subdivisions. \throw UsageError beyond these
[[nodiscard]] double icosphere_inner_radius(std::uint32_t subdivisions);

/// All points that are as near to the solid as the distance, or, of a negative one, those of the
/// solid all around which is solid as far as that. The Minkowski sum, or difference, of the solid
/// and a polyhedron, exact over corners, and sums of corners, that are doubles; others are rounded
/// once each.
///
/// With a ball of radius r that the polyhedron is within, and its inner radius i, the grown solid
/// has all points nearer than i r and, to within rounding of 1e-9 r, none farther than r; the
/// shrunk one none less deep than i r and all that are deeper than r. Around the ball, r and r / i
/// take their places. A cube and an octahedron are exact.
///
/// Of a solid that is not convex there is a piece for each triangle: some 20 microseconds a corner
/// of the polyhedron, and the union of all.
/// \throw UsageError for a distance that is not finite and more subdivisions; what minkowski_sum()
/// throws
[[nodiscard]] Solid offset_of_solid(const Solid& solid, double distance,
                                    const SolidOffsetOptions& options = {});

/// By a solid of the caller in the place of a ball of radius 1, scaled by the distance: the sum, or
/// difference. Convex ones are fast.
[[nodiscard]] Solid offset_of_solid(const Solid& solid, double distance, const Solid& unit_tool,
                                    const MinkowskiOptions& options = {});

}  // namespace trisect
