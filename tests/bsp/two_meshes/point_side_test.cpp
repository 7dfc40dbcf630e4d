// SPDX-License-Identifier: Apache-2.0
//
// Sides of a mesh on which points are, on its surface as well (two_meshes/point_side.h).

#include <trisect/bsp/two_meshes/point_side.h>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>

namespace {

using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::detail::InfinitesimalShift;
using trisect::detail::PointSide;

LatticeMesh cube() {
    trisect::ImportOptions options;
    options.lattice = trisect::Lattice{0};
    return trisect::import_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4}), options).mesh;
}

TEST(PointSide, OfPointsInsideAndOutside) {
    const LatticeMesh mesh = cube();
    const PointSide side(mesh, false, InfinitesimalShift{}, false);
    for (std::int64_t x = -1; x <= 5; x += 2)
        for (std::int64_t y = -1; y <= 5; y += 2)
            for (std::int64_t z = -1; z <= 5; z += 2) {
                const bool within = x > 0 && x < 4 && y > 0 && y < 4 && z > 0 && z < 4;
                EXPECT_EQ(side.is_below({x, y, z}), within);
            }
}

// What is moved along the axes leaves points of the surface on definite sides.
TEST(PointSide, OfPointsOfTheSurface) {
    const LatticeMesh mesh = cube();
    InfinitesimalShift shift;  // towards greater coordinates
    const PointSide of_moved_mesh(mesh, false, shift, false);
    const PointSide of_moved_points(mesh, true, shift, false);
    for (std::int64_t x = 0; x <= 4; x += 2)
        for (std::int64_t y = 0; y <= 4; y += 2)
            for (std::int64_t z = 0; z <= 4; z += 2) {
                const bool in_moved = x > 0 && y > 0 && z > 0;
                EXPECT_EQ(of_moved_mesh.is_below({x, y, z}), in_moved);
                EXPECT_EQ(of_moved_points.is_below({x, y, z}), x < 4 && y < 4 && z < 4);
            }
}

TEST(PointSide, OfPointsOfAMeshThatGrowsOrShrinks) {
    const LatticeMesh mesh = cube();
    InfinitesimalShift shift;
    shift.centre = {2, 2, 2};
    for (const int growth : {1, -1}) {
        shift.growth = static_cast<std::int8_t>(growth);
        const PointSide of_mesh(mesh, false, shift, false);
        const PointSide of_points(mesh, true, shift, false);
        for (const LatticePoint& p :
             {LatticePoint{0, 0, 0}, LatticePoint{4, 0, 4}, LatticePoint{2, 2, 4},
              LatticePoint{0, 1, 3}, LatticePoint{4, 4, 1}}) {
            EXPECT_EQ(of_mesh.is_below(p), growth > 0);
            EXPECT_EQ(of_points.is_below(p), growth < 0);
        }
    }
}

}  // namespace
