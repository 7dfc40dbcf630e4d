// SPDX-License-Identifier: Apache-2.0
//
// Extrusions of regions of the plane: twisted, tapered and turned.
#pragma once

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/modelling/plane_region.h>

#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// Whether linear_extrude() moves its region without changing it.
[[nodiscard]] bool is_straight(const CsgArguments& arguments);
[[nodiscard]] PolygonMesh csg_twisted(const PlaneRegion& region, const CsgArguments& arguments,
                                      double low, double high);
[[nodiscard]] PolygonMesh csg_revolved(const PlaneRegion& region, const CsgArguments& arguments);

}  // namespace trisect::detail
