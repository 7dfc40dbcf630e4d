// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/modelling/offset.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trisect {
namespace {

using Corners = OffsetOptions::Corners;

Solid square(double low, double high) {
    return Solid::from_mesh(make_box({low, low, 0}, {high, high, 1}));
}

double area_of(const Solid& region, double distance, Corners corners, std::uint32_t segments = 8) {
    OffsetOptions options;
    options.corners = corners;
    options.segments = segments;
    return volume(offset_of_region(region, distance, options));
}

TEST(Offset, CornersOfASquare) {
    EXPECT_EQ(area_of(square(0, 10), 2, Corners::Miter), 196);
    // Each corner has two triangles of two sides 2 and 45 degrees between.
    EXPECT_NEAR(area_of(square(0, 10), 2, Corners::Round), 180 + 8 * std::sqrt(2.0), 1e-12);
    // A cut off triangle has the height 2 sqrt(2) - 2.
    const double cut = std::pow(2 * std::sqrt(2.0) - 2, 2);
    EXPECT_NEAR(area_of(square(0, 10), 2, Corners::Chamfer), 196 - 4 * cut, 1e-12);
}

TEST(Offset, HolesShrinkAndGrow) {
    const Solid frame = evaluate(square(0, 10) - square(3, 7));
    EXPECT_EQ(area_of(frame, 1, Corners::Miter), 144 - 4);
    EXPECT_EQ(area_of(frame, 2, Corners::Miter), 196);
    EXPECT_EQ(area_of(frame, -1, Corners::Miter), 64 - 36);
    EXPECT_NEAR(area_of(frame, -1, Corners::Round), 64 - (16 + 16 + 2 * std::sqrt(2.0)), 1e-12);
    EXPECT_EQ(area_of(frame, -2, Corners::Miter), 0);
}

TEST(Offset, ArcsBeginWhereTheEdgeBeforeThemEnds) {
    // With seven segments a right angle has one whole one and what is left of it.
    const double step = 2 * std::numbers::pi / 7;
    const double corner = (std::sin(step) + std::sin(std::numbers::pi / 2 - step)) / 2;
    EXPECT_NEAR(area_of(square(0, 10), 1, Corners::Round, 7), 140 + 4 * corner, 1e-12);
}

TEST(Offset, MitersHaveALimit) {
    OffsetOptions options;
    options.corners = Corners::Miter;
    // The corner of a square is sqrt(2) distances away from the corner of the grown one.
    options.miter_limit = std::sqrt(2.0);
    EXPECT_EQ(volume(offset_of_region(square(0, 10), 2, options)), 196);
    options.miter_limit = 1.41;
    const double chamfered = volume(offset_of_region(square(0, 10), 2, options));
    EXPECT_EQ(chamfered, area_of(square(0, 10), 2, Corners::Chamfer));
    options.miter_limit = 0.5;
    EXPECT_THROW((void)offset_of_region(square(0, 10), 2, options), UsageError);
}

TEST(Offset, BevelsAreOneCut) { EXPECT_EQ(area_of(square(0, 10), 2, Corners::Bevel), 196 - 8); }

// Two squares in one mesh, overlapping: the walls of each within the other bound nothing.
TEST(Offset, OfAMeshThatMeetsItself) {
    PolygonMesh both = make_box({0, 0, 0}, {2, 2, 1});
    append(both, make_box({1, 1, 0}, {3, 3, 1}));
    const Solid overlapping = Solid::from_mesh(both, {.embedding = Embedding::Check});
    EXPECT_EQ(area_of(overlapping, 0.5, Corners::Miter), 14);
    EXPECT_EQ(area_of(overlapping, -0.25, Corners::Miter), 4.25);
}

TEST(Offset, Refusals) {
    EXPECT_THROW((void)area_of(square(0, 1), NAN, Corners::Round), UsageError);
    EXPECT_THROW((void)area_of(square(0, 1), 1, Corners::Round, 2), UsageError);
}

}  // namespace
}  // namespace trisect
