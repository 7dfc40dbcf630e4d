// SPDX-License-Identifier: Apache-2.0
//
// Boxes and other meshes as solids, and the volume of a formula.
#pragma once

#include <cstdint>
#include <string>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/point3d.h>

namespace solids {

[[nodiscard]] trisect::Solid box(const trisect::Point3d& low, const trisect::Point3d& high);
[[nodiscard]] trisect::Solid box(double x0, double y0, double z0, double x1, double y1, double z1);
/// The cube from (low, low, low) to (high, high, high).
[[nodiscard]] trisect::Solid box(double low, double high);

/// An icosphere of 20 * 4^level triangles around a point, its corners rounded to multiples of a
/// unit.
[[nodiscard]] trisect::Solid ball(double radius, std::uint32_t level,
                                  const trisect::Point3d& at = {}, double unit = 0x1p-20);

/// A mesh as an operand of a formula.
[[nodiscard]] trisect::Expression of_mesh(const trisect::PolygonMesh& mesh);

/// The exact volume of what a formula gives, as text.
[[nodiscard]] std::string volume(const trisect::Expression& formula);

}  // namespace solids
