// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/few_facets.h>

#include <gtest/gtest.h>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

#include "support/mesh_builders.h"

namespace {

using trisect::Point3d;
using trisect::Solid;

// Beside a cube from 0 to 8.
bool touch(Point3d low, Point3d high) {
    const trisect::detail::SolidStates solids{
        trisect::detail::state_of(Solid::from_mesh(trisect::test::cuboid({0, 0, 0}, {8, 8, 8}))),
        trisect::detail::state_of(Solid::from_mesh(trisect::test::cuboid(low, high)))};
    return trisect::detail::are_apart_or_touch(solids);
}

TEST(FewFacets, CornersOnFacetsAndBoxesApartShow) {
    EXPECT_TRUE(touch({9, 0, 0}, {12, 8, 8}));   // apart
    EXPECT_TRUE(touch({8, 2, 2}, {12, 6, 6}));   // with a facet on a facet
    EXPECT_TRUE(touch({4, 4, 6}, {9, 9, 8}));    // with a corner in a facet
    EXPECT_TRUE(touch({-1, -1, 2}, {9, 9, 8}));  // of which the other one's corners lie in a facet
    EXPECT_FALSE(touch({4, 4, 4}, {9, 9, 9}));
    EXPECT_FALSE(touch({2, 2, -1}, {6, 6, 9}));
    EXPECT_FALSE(touch({2, 2, 2}, {6, 6, 6}));
    EXPECT_FALSE(touch({-1, 2, 2}, {9, 6, 6}));
}

}  // namespace
