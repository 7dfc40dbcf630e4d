// SPDX-License-Identifier: Apache-2.0
//
// Solids of revolution, of regions of the plane.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct RevolutionOptions {
    /// Degrees, counter-clockwise seen from above; clockwise below 0. 360 and more is all around.
    double angle = 360;
    /// Of a whole circle; of a part of it as many as fit, at least one.
    std::uint32_t segments = 32;
    /// Degrees from the x axis at which it begins.
    double start = 0;
};

/// The region turned about the z axis: its x is the distance from the axis, its y becomes z. A
/// region of negative x is turned from the other side.
///
/// Corners lie on the circles, so the solid is within that of the smooth surface; the volume of a
/// part between two angles, d apart, is that of Pappus' rule times sin(d) / d. Each corner is
/// rounded, by a unit in the last place or two; x and y of multiples of 90 degrees are exact.
/// \throw UsageError for a region on both sides of the axis, fewer than three segments of a whole
/// circle, an angle of 0 or numbers that are not finite; LimitError for more than 2^24 corners
[[nodiscard]] Solid revolution(const PlaneRegion& region, const RevolutionOptions& options = {});
/// The same before it is a solid. Faces on the axis, which are flat, are in it; import leaves them
/// out.
[[nodiscard]] PolygonMesh revolution_mesh(const PlaneRegion& region,
                                          const RevolutionOptions& options = {});

}  // namespace trisect
