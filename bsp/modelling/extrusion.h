// SPDX-License-Identifier: Apache-2.0
//
// Extrusions of regions of the plane, twisted and tapered.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct ExtrusionOptions {
    /// Degrees by which the upper end is turned about the z axis against the lower one,
    /// counter-clockwise seen from above.
    double twist = 0;
    /// Factors of x and y of the upper end, not negative. 0, 0 makes a point of it.
    std::array<double, 2> scale{1, 1};
    /// Layers of equal height; 0: as few as turn by 10 degrees at most.
    std::uint32_t divisions = 0;
};

/// The region swept from one height to another. Between layers walls are two triangles, of which
/// the shorter diagonal is an edge: these bulge, so a twisted convex region has more volume than
/// its smooth sweep, by a part that falls with the number of layers.
///
/// Without twist and scale exact, with the region's corners as they are. Else each corner of each
/// layer is rounded: by a few units in the last place of the region's largest coordinate. Where
/// that, or a twist by much in one layer, makes walls meet each other, what they go around counts.
/// \throw UsageError unless low < high, for numbers that are not finite and negative factors;
/// LimitError for more than 2^24 corners
[[nodiscard]] Solid extrusion(const PlaneRegion& region, double low, double high,
                              const ExtrusionOptions& options = {});
/// The same before it is a solid, of layers also where they are straight. Faces that the scale
/// makes flat are in it; import leaves them out.
[[nodiscard]] PolygonMesh extrusion_mesh(const PlaneRegion& region, double low, double high,
                                         const ExtrusionOptions& options = {});

}  // namespace trisect
