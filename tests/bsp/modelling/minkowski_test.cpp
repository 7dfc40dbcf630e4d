// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>

#include <gtest/gtest.h>

#include "support/solids.h"

namespace trisect {
namespace {

using solids::box;

/// A cube with side 6 around a cavity with side 4.
Solid hollow() { return evaluate(box({0, 0, 0}, {6, 6, 6}) - box({1, 1, 1}, {5, 5, 5})); }

std::string volume_of(const Solid& solid) { return exact_volume(solid).to_string(); }

TEST(Minkowski, SumsOfBoxes) {
    EXPECT_EQ(volume_of(minkowski_sum(box({0, 0, 0}, {1, 2, 3}), box({-1, 0, 0}, {1, 1, 1}))),
              "36");
    EXPECT_TRUE(minkowski_sum(Solid(), hollow()).is_empty());
}

TEST(Minkowski, ACavityShrinksUntilItIsFull) {
    const Solid half = box({0, 0, 0}, {0.5, 0.5, 0.5});
    // The outside is 6.5 wide, the cavity 3.5, whichever comes first.
    EXPECT_EQ(volume_of(minkowski_sum(hollow(), half)), "927/4");
    EXPECT_EQ(volume_of(minkowski_sum(half, hollow())), "927/4");
    EXPECT_EQ(volume_of(minkowski_sum(hollow(), box({0, 0, 0}, {4, 4, 4}))), "1000");
}

TEST(Minkowski, ASolidWithinTheCavityIsSummedAsAWhole) {
    // Both are hollow, and the small one is thinner than the other's walls: 6.75^3 - 3.25^3.
    const Solid small = transformed(hollow(), AffineMap::scaling({0.125, 0.125, 0.125}));
    EXPECT_EQ(volume_of(minkowski_sum(hollow(), small)), "8743/32");
}

TEST(Minkowski, PartsThatAreApart) {
    const Solid two = evaluate(box({0, 0, 0}, {1, 1, 1}) | box({10, 0, 0}, {11, 1, 1}));
    EXPECT_EQ(volume_of(minkowski_sum(two, two)), "24");
    EXPECT_EQ(volume_of(minkowski_difference(box({0, 0, 0}, {12, 4, 4}), two)), "9");
}

// Two boxes in one mesh, overlapping: the walls of each within the other are no boundary.
TEST(Minkowski, DifferenceOfAMeshThatMeetsItself) {
    PolygonMesh both = make_box({0, 0, 0}, {4, 4, 4});
    append(both, make_box({2, 0, 0}, {6, 4, 4}));
    const Solid overlapping = Solid::from_mesh(both, {.embedding = Embedding::Check});
    EXPECT_EQ(volume_of(minkowski_difference(overlapping, box({0, 0, 0}, {1, 1, 1}))), "45");
    EXPECT_EQ(volume_of(minkowski_sum(overlapping, box({0, 0, 0}, {1, 1, 1}))), "175");
}

TEST(Minkowski, DifferencesUndoSumsOfBoxes) {
    const Solid a = box({0, 0, 0}, {3, 4, 5});
    const Solid b = box({-1, 0, 1}, {1, 1, 2});
    const Solid back = minkowski_difference(minkowski_sum(a, b), b);
    EXPECT_TRUE(evaluate(back ^ a).is_empty());
    // 5.5^3 - 4.5^3.
    EXPECT_EQ(volume_of(minkowski_difference(hollow(), box({0, 0, 0}, {0.5, 0.5, 0.5}))), "301/4");
    EXPECT_TRUE(minkowski_difference(b, a).is_empty());
}

// modelling_sets --seed 20261128 --hulls 4000 --sums 3000 --only 4036, whose oracle took what is in
// the first box.
TEST(Minkowski, ADifferenceIsBesideTheFirstWhereTheSecondIsBesideTheOrigin) {
    const Solid a = box({11, 10, 4}, {15, 13, 11});
    const Solid places = minkowski_difference(a, box({3, 3, 7}, {4, 5, 10}));
    EXPECT_TRUE(evaluate(places ^ box({8, 7, -3}, {11, 8, 1})).is_empty());
}

TEST(Minkowski, TurnedBoxesAreConvexWithinRounding) {
    const AffineMap turn = AffineMap::rotation({1, 2, 3}, 33);
    const Solid a = transformed(box({0, 0, 0}, {1, 1, 1}), turn);
    const Solid b = transformed(box({0, 0, 0}, {2, 1, 1}), turn);
    MinkowskiOptions options;
    options.convex = MinkowskiOptions::Convex::WithinRounding;
    EXPECT_NEAR(volume(minkowski_sum(a, b, options)), 12, 1e-12);
}

TEST(Minkowski, HolesAreNoRoundingHoweverSmallTheyAre) {
    MinkowskiOptions options;
    options.convex = MinkowskiOptions::Convex::WithinRounding;
    const Solid plate =
        evaluate(box({-500000, -500000, 0}, {500000, 500000, 1}) - box({-1, -1, -1}, {1, 1, 2}));
    const Solid sum = minkowski_sum_of_regions(plate, box({0, 0, 0}, {1, 1, 1}), options);
    EXPECT_EQ(volume_of(sum), "1000002000000");
}

TEST(Minkowski, RoundSolidsGoByExtremeSumsAlone) {
    const Solid ball = Solid::from_mesh(make_icosphere(1, 2));
    const Solid twice = minkowski_sum(ball, ball);
    EXPECT_EQ(counts(twice).vertices, counts(ball).vertices);
    EXPECT_NEAR(volume(twice), 8 * volume(ball), 1e-12);
}

TEST(Minkowski, RegionsAndLimits) {
    const Solid ring = evaluate(box({0, 0, 0}, {6, 6, 1}) - box({1, 1, -1}, {5, 5, 2}));
    EXPECT_EQ(volume_of(minkowski_sum_of_regions(ring, box({0, 0, 0}, {1, 1, 1}))), "40");
    EXPECT_EQ(volume_of(minkowski_sum_of_regions(ring, ring)), "144");
    MinkowskiOptions few;
    few.most_pieces = 10;
    EXPECT_THROW((void)minkowski_sum(hollow(), hollow(), few), LimitError);
}

}  // namespace
}  // namespace trisect
