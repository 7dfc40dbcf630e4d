// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/stroke_pieces.h>

#include <trisect/bsp/csg/csg_region.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

double area_of_stroke(const Stroke& stroke) {
    Drawing drawing;
    drawing.shapes.push_back({{}, {stroke_pieces(stroke)}});
    return volume(evaluate(drawing_prism(drawing, CsgFrame())));
}

TEST(StrokePieces, EndsAndCorners) {
    EXPECT_EQ(area_of_stroke({{{0, 0}, {10, 0}}, 2, Stroke::Cap::Butt}), 20);
    EXPECT_EQ(area_of_stroke({{{0, 0}, {10, 0}}, 2, Stroke::Cap::Square}), 24);
    EXPECT_NEAR(area_of_stroke({{{0, 0}, {10, 0}}, 2, Stroke::Cap::Round}), 23.1416, 1e-3);
    EXPECT_NEAR(area_of_stroke({{{0, 0}, {10, 0}, {10, 10}}, 2, Stroke::Cap::Butt}), 40, 1e-12);
    EXPECT_NEAR(area_of_stroke({{{0, 0}, {10, 0}, {10, -10}}, 2, Stroke::Cap::Butt}), 40, 1e-12);
    // Back along itself: the corner has a square end.
    EXPECT_NEAR(area_of_stroke({{{0, 0}, {10, 0}, {5, 0}}, 2, Stroke::Cap::Butt}), 22, 1e-12);
}

TEST(StrokePieces, SharpCornersAreCutOff) {
    const double area = area_of_stroke({{{10, 10}, {20, 10}, {10, 11}}, 2, Stroke::Cap::Square});
    EXPECT_GT(area, 25);
    EXPECT_LT(area, 36);
}

TEST(StrokePieces, FewerThanTwoPointsAreNoStroke) {
    EXPECT_TRUE(stroke_pieces({{{1, 1}, {1, 1}}, 2, Stroke::Cap::Round}).empty());
    EXPECT_TRUE(stroke_pieces({{{1, 1}, {2, 1}}, 0, Stroke::Cap::Round}).empty());
}

}  // namespace
}  // namespace trisect::detail
