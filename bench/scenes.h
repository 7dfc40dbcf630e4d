// SPDX-License-Identifier: Apache-2.0
//
// The operands of benchmarks and campaigns as plain doubles, made in one place so that every engine
// sees the same ones.
#pragma once

#include <cstdint>

#include <trisect/brep/polygon_mesh.h>

namespace scenes {

/// The mesh turned by 37 degrees about (1, 2, 3) through the centre of its box and moved by a tenth
/// of its box in x, y and z.
[[nodiscard]] trisect::PolygonMesh turned(const trisect::PolygonMesh& mesh);

/// A sphere of radius 1 about the origin: an icosahedron with every triangle cut in four `level`
/// times, 20 · 4^level triangles.
[[nodiscard]] trisect::PolygonMesh icosphere(int level);

[[nodiscard]] trisect::PolygonMesh moved(trisect::PolygonMesh mesh, const trisect::Point3d& by);

/// A vector of the given length along (1, 2, 3).
[[nodiscard]] trisect::Point3d along_1_2_3(double length);

/// The enclosed volume and the area of a closed triangle mesh in long double, with the centre of
/// the box as origin: as good as the coordinates, whoever made them.
struct Size {
    double volume = 0;
    double area = 0;
};
[[nodiscard]] Size size_of(const trisect::PolygonMesh& mesh);

}  // namespace scenes
