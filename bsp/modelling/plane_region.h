// SPDX-License-Identifier: Apache-2.0
//
// Regions of the plane, as outlines and as prisms.
// A region that takes part in formulas is the prism over it between z = 0 and z = 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// Outlines run counter-clockwise, holes clockwise; the inside is on the left of every loop.
struct PlaneRegion {
    std::vector<Point2d> points;
    std::vector<std::vector<std::uint32_t>> loops;
    std::vector<IndexTriangle> triangles;
};

/// The faces of a solid at one height that look up, or down: their regions, seen from above.
/// Corners that are no doubles are rounded, once; all others are as they are. Costs to_brep().
/// \throw UnsupportedError for an unbounded set
enum class FacesLook : std::uint8_t { Up, Down };
[[nodiscard]] PlaneRegion region_of_faces(const Solid& solid, double height,
                                          FacesLook look = FacesLook::Up);
/// The same of what evaluate() returned, whose boundary does not meet itself.
[[nodiscard]] PlaneRegion region_of_result_faces(const Solid& solid, double height, FacesLook look);

/// The region of outlines that may overlap, cross or touch. Crossings that are no doubles are
/// rounded, once. \throw LimitError for corners that are not finite
[[nodiscard]] PlaneRegion region_of_outlines(std::span<const FlatOutline> outlines,
                                             OutlineRule rule = OutlineRule::Odd);
[[nodiscard]] PlaneRegion region_of_outline(const FlatOutline& outline);
/// That of a prism along the z axis, whatever its heights.
/// \throw UsageError for any other solid; UnsupportedError for an unbounded set
[[nodiscard]] PlaneRegion region_of_prism(const Solid& prism);

/// The outlines of a prism between z = 0 and z = 1, without corners that rounding made equal.
[[nodiscard]] std::vector<Outline> outlines_of_prism(const Solid& prism);

/// The prism over a region, between two heights: walls are quadrilaterals, ends triangles.
[[nodiscard]] PolygonMesh prism_of_region(const PlaneRegion& region, double low, double high);

/// The same as a solid; outlines that rounding made meet themselves are resolved.
[[nodiscard]] Solid solid_of_region(const PlaneRegion& region, double low = 0, double high = 1);

}  // namespace trisect
