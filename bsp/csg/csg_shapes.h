// SPDX-License-Identifier: Apache-2.0
//
// Shapes of modelling programs as meshes.
// Facets are those that OpenSCAD's manual describes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// Most facets of a circle, and most facets of one shape.
inline constexpr double circle_limit = 1 << 16;
inline constexpr double shape_limit = 1 << 24;

/// How many sides a circle of this radius has, by $fn, $fa and $fs. \throw CsgError (Limit)
[[nodiscard]] std::uint32_t csg_fragments(const CsgArguments& arguments, double radius);

// Meshes without faces are empty sets: a size that is not positive.
[[nodiscard]] PolygonMesh csg_cube(const CsgArguments& arguments);
[[nodiscard]] PolygonMesh csg_sphere(const CsgArguments& arguments);
[[nodiscard]] PolygonMesh csg_cylinder(const CsgArguments& arguments);
[[nodiscard]] PolygonMesh csg_polyhedron(const CsgArguments& arguments);

/// Closed paths; a point is inside where an odd number of them goes around it.
[[nodiscard]] std::vector<Outline> csg_square(const CsgArguments& arguments);
[[nodiscard]] std::vector<Outline> csg_circle(const CsgArguments& arguments);
[[nodiscard]] std::vector<Outline> csg_polygon(const CsgArguments& arguments);

/// A band of quadrilaterals between two rings of n points each, `lower` and `upper` being their
/// first points; in triangles, since corners are rounded.
void add_band(PolygonMesh& mesh, std::uint32_t lower, std::uint32_t upper, std::uint32_t n);

}  // namespace trisect::detail
