// SPDX-License-Identifier: Apache-2.0
//
// Walls above a boundary: every cell has some of it, few polygons, and all that is in the cell.

#include <trisect/bsp/hierarchies/partitions/split_cells.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/partitions/inner_balls.h>
#include <trisect/bsp/hierarchies/partitions/plane_tree.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

TEST(SplitCells, ATorusInCellsOfThirtyTwoPolygons) {
    const InterferenceModel torus(Solid::from_mesh(make_torus(1, 0.25, 40, 20)));
    const SplitCells splitters = SplitCells::over(trisect::detail::data_of(torus), 32);
    EXPECT_EQ(splitters.cells.size(), splitters.splitters.size() + 1);
    std::set<std::uint32_t> triangles;
    for (const SplitCells::Cell& cell : splitters.cells) {
        EXPECT_FALSE(cell.polygons.empty());
        EXPECT_LE(cell.polygons.size(), 32U);
        ASSERT_EQ(cell.polygons.size(), cell.triangles.size());
        triangles.insert(cell.triangles.begin(), cell.triangles.end());
        for (const ConvexPolygon& p : cell.polygons)
            for (const Plane& splitter : cell.splitters) {
                const auto parts = p.classify(splitter);
                EXPECT_GT(parts.below, 0U);
                EXPECT_EQ(parts.above, 0U);
            }
    }
    EXPECT_EQ(triangles.size(), torus.triangle_count());
}

// All triangles share a corner: no splitter helps, and a cell stays as it is.
TEST(SplitCells, AFanAroundACornerIsNotDividedForever) {
    PolygonMesh cone;
    constexpr std::uint32_t n = 200;
    cone.points.push_back({0, 0, 1000});
    cone.points.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * i / n;
        cone.points.push_back(
            {std::round(1e6 * std::cos(angle)), std::round(1e6 * std::sin(angle)), 0});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        cone.add_triangle(0, 2 + i, 2 + (i + 1) % n);
        cone.add_triangle(1, 2 + (i + 1) % n, 2 + i);
    }
    const InterferenceModel model(Solid::from_mesh(cone));
    const SplitCells splitters = SplitCells::over(trisect::detail::data_of(model), 4);
    std::size_t polygons = 0;
    for (const SplitCells::Cell& cell : splitters.cells) polygons += cell.polygons.size();
    EXPECT_LE(polygons, 12 * model.triangle_count());
}

TEST(SplitCells, TreesOfConvexSolidsAreShallow) {
    const InterferenceModel ball(Solid::from_mesh(make_uv_sphere(1, 64, 32)));
    const InterferenceModel box(Solid::from_mesh(make_box({0, 0, 0}, {4, 4, 4})));
    for (const auto make : {PlaneTree::classic, PlaneTree::multidimensional}) {
        const PlaneTree tree = make(trisect::detail::data_of(ball));
        // Walls do not part the 64 triangles around a pole.
        EXPECT_LE(tree.depth(), 80U);
        EXPECT_EQ(tree.stray_count(), 0U);
        // The largest balls are those of a box whose planes leave one leaf inside.
        const PlaneTree one = make(trisect::detail::data_of(box));
        const auto balls = one.inner_balls(
            {trisect::detail::data_of(box).lo, trisect::detail::data_of(box).hi}, 8);
        ASSERT_EQ(balls.size(), 1U);
        const double half =
            0.5 * (trisect::detail::data_of(box).hi[0] - trisect::detail::data_of(box).lo[0]);
        EXPECT_GT(balls[0].radius, 0.9 * half);
        EXPECT_LE(balls[0].radius, half);
    }
}

TEST(InnerBalls, ThePartBelowAPlaneIsAsLargeAsCanBe) {
    const InnerBall ball{{0, 0, 0}, 10};
    const auto half = part_below(ball, {{2, 0, 0}, 0});
    ASSERT_TRUE(half);
    EXPECT_LE(half->radius, 5);
    EXPECT_GT(half->radius, 4.999);
    EXPECT_NEAR(half->center[0], -5, 1e-6);
    const auto cap = part_above(ball, {{0, 3, 0}, -24});
    ASSERT_TRUE(cap);
    EXPECT_NEAR(cap->radius, 1, 1e-6);
    EXPECT_FALSE(part_above(ball, {{0, 0, 1}, -10}));
    EXPECT_EQ(part_below(ball, {{0, 0, 1}, -11})->radius, 10);
}

TEST(InnerBalls, LeastStretchIsALowerBound) {
    detail::ApproximateMap map;
    map.m = {{{0, -2, 0}, {2, 0, 0}, {0, 0, 3}}};
    EXPECT_LE(least_stretch(map), 2);
    EXPECT_GT(least_stretch(map), 1.9999);
    map.m = {{{1, 1, 0}, {1, 1, 0}, {0, 0, 1}}};
    EXPECT_EQ(least_stretch(map), 0);
}

}  // namespace
