// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/placement.h>

#include <gtest/gtest.h>

namespace {

using namespace trisect;
using detail::Placement;

Point3d image(const Placement& placement, const Point3d& p, ModelReport& report) {
    return placement.apply(p, report);
}

TEST(Placement, QuaternionsOfAnyLength) {
    ModelReport report;
    // A quarter turn about z, of length 2.
    const Placement turn = Placement::from_parts({1, 1, 1}, {0, 0, 1.5, 1.5}, {1, 2, 3});
    EXPECT_EQ(image(turn, {1, 0, 0}, report), (Point3d{1, 3, 3}));
    EXPECT_EQ(image(turn, {0, 1, 0}, report), (Point3d{0, 2, 3}));
    EXPECT_EQ(report, ModelReport());
    EXPECT_EQ(turn.orientation(), 1);
    EXPECT_EQ(Placement::from_parts({-1, 2, 3}, {0, 0, 0, 1}, {0, 0, 0}).orientation(), -1);
}

TEST(Placement, ScaleComesBeforeTheTurn) {
    ModelReport report;
    const Placement p = Placement::from_parts({3, 1, 1}, {0, 0, 1, 1}, {0, 0, 0});
    EXPECT_EQ(image(p, {1, 1, 1}, report), (Point3d{-1, 3, 1}));
}

TEST(Placement, RoundsOnce) {
    ModelReport report;
    const Placement third = Placement::from_rows({0.1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    // 0.1 ten times over, exactly, is a little more than 1; in doubles each step would round.
    Placement power;
    Placement back = Placement::from_rows({10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    power = third.then(back);
    EXPECT_EQ(image(power, {1, 0, 0}, report), (Point3d{1, 0, 0}));
    EXPECT_EQ(report.rounded_vertices, 1U);
    EXPECT_GT(report.largest_move, 5e-17);
    EXPECT_FALSE(power.is_identity());
    EXPECT_TRUE(Placement().then(Placement()).is_identity());
}

}  // namespace
