// SPDX-License-Identifier: Apache-2.0
//
// Extrusions of regions of the plane: twisted, tapered and turned.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/solid.h>

#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// Outlines run counter-clockwise, holes clockwise.
struct CsgRegion {
    std::vector<Point2d> points;
    std::vector<std::vector<std::uint32_t>> loops;
    std::vector<IndexTriangle> triangles;
};

/// The upper end of a prism that ends at z = 1; corners that booleans have made are rounded.
[[nodiscard]] CsgRegion region_of_prism(const Solid& prism);

/// Whether linear_extrude() moves its region without changing it.
[[nodiscard]] bool is_straight(const CsgArguments& arguments);
[[nodiscard]] PolygonMesh csg_twisted(const CsgRegion& region, const CsgArguments& arguments,
                                      double low, double high);
[[nodiscard]] PolygonMesh csg_revolved(const CsgRegion& region, const CsgArguments& arguments);

}  // namespace trisect::detail
