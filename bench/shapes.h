// SPDX-License-Identifier: Apache-2.0
//
// The operands of benchmarks and campaigns as plain doubles, made in one place so that every engine
// sees the same ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace shapes {

/// The mesh turned by 37 degrees about (1, 2, 3) through the centre of its box and moved by a tenth
/// of its box in x, y and z.
[[nodiscard]] trisect::PolygonMesh turned(const trisect::PolygonMesh& mesh);

/// A sphere of radius 1 about the origin: an icosahedron with every triangle cut in four `level`
/// times, 20 · 4^level triangles.
[[nodiscard]] trisect::PolygonMesh icosphere(int level);

/// A sphere about the origin with poles on the z axis: `around` meridians and `rings` circles
/// between the poles, 2 · around · rings triangles. `bumps`: the largest change of its radius,
/// which is 1.
[[nodiscard]] trisect::PolygonMesh globe(std::uint32_t around, std::uint32_t rings,
                                         double bumps = 0);

[[nodiscard]] trisect::PolygonMesh moved(trisect::PolygonMesh mesh, const trisect::Point3d& by);

/// A vector of the given length along (1, 2, 3).
[[nodiscard]] trisect::Point3d along_1_2_3(double length);

/// An axis-aligned box, every side a grid of n by n squares cut in two: 12 n² triangles.
[[nodiscard]] trisect::PolygonMesh block(const trisect::Point3d& low, const trisect::Point3d& high,
                                         int n = 1);

/// The bars along one axis that a Menger sponge of side 3^level is short of: disjoint boxes with
/// integer corners that stick out by 1 at both ends.
[[nodiscard]] trisect::PolygonMesh menger_bars(int level, std::size_t axis);

/// Both meshes in one, without connecting them.
using trisect::append;

using Matrix = std::array<trisect::Point3d, 3>;

[[nodiscard]] Matrix rotation(const trisect::Point3d& axis, double degrees);
/// Every point p to m p + by.
[[nodiscard]] trisect::PolygonMesh moved(trisect::PolygonMesh mesh, const Matrix& m,
                                         const trisect::Point3d& by);

/// Splitmix64 (Steele, Lea and Flood 2014): the same numbers with every compiler and library.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Uniform in [0, 1), 53 bits.
    [[nodiscard]] double uniform();
    /// Uniform among all rotations (Shoemake, Graphics Gems III, "Uniform random rotations").
    [[nodiscard]] Matrix rotation();
    [[nodiscard]] trisect::Point3d in_unit_box();

private:
    std::uint64_t state_;
};

/// The same triangles with every point rounded to the finest lattice that holds all of `meshes`, so
/// that exact and inexact engines get the same numbers and an exact one rounds nothing.
void put_on_one_lattice(std::vector<trisect::PolygonMesh>& meshes);

/// The enclosed volume and the area of a closed triangle mesh in long double, with the centre of
/// the box as origin: as good as the coordinates, whoever made them.
struct Size {
    double volume = 0;
    double area = 0;
};
[[nodiscard]] Size size_of(const trisect::PolygonMesh& mesh);

/// Edges that are not used equally often in both directions; 0 for a closed mesh.
[[nodiscard]] std::size_t open_edges(const trisect::PolygonMesh& mesh);

/// Of all arrays, bit by bit (FNV-1a): equal for meshes that are the same in every respect.
[[nodiscard]] std::uint64_t hash_of(const trisect::PolygonMesh& mesh);

}  // namespace shapes
