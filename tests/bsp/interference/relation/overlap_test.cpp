// SPDX-License-Identifier: Apache-2.0
//
// The overlap of placed solids: volumes that are known, and equations between volumes.

#include <trisect/bsp/interference/interference_overlap.h>

#include <gtest/gtest.h>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>

#include "support/interference_oracle.h"
#include "support/models.h"

namespace {

using models::box;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Overlap;
using trisect::overlap;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

ExactRational fraction(int p, int q) { return ExactRational(p) / ExactRational(q); }

TEST(Overlaps, OfBoxesAreBoxes) {
    const auto a = box({0, 0, 0}, {4, 4, 4});
    const auto b = box({0, 0, 0}, {2, 2, 2});
    const Overlap o = overlap(a, Pose(), b, Pose::from_translation({3, 3.5, -1}));
    EXPECT_TRUE(o.is_exact);
    EXPECT_EQ(o.scale, ExactRational(1));
    EXPECT_EQ(o.volume, fraction(1, 2));
    EXPECT_EQ(trisect::exact_volume(o.scaled_solid.to_brep()), fraction(1, 2));
    // Touching and disjoint solids overlap in nothing.
    EXPECT_TRUE(overlap(a, Pose(), b, Pose::from_translation({4, 0, 0})).scaled_solid.is_empty());
    EXPECT_TRUE(overlap(a, Pose(), b, Pose::from_translation({9, 0, 0})).scaled_solid.is_empty());
    EXPECT_TRUE(overlap(a, Pose(), InterferenceModel(), Pose()).scaled_solid.is_empty());
}

// A square and the same turned about its middle by the angle of the 3-4-5 triangle share
// 2 / (1 + sin + cos) of their area, 5/6.
TEST(Overlaps, UnderARationalRotationHaveAnExactVolume) {
    const auto cube = box({-1, -1, -1}, {1, 1, 1});
    const Pose turn = Pose::from_quaternion({2, 0, 0, 1});
    const Overlap o = overlap(cube, Pose(), cube, turn);
    EXPECT_TRUE(o.is_exact);
    EXPECT_EQ(o.scale, ExactRational(5));
    EXPECT_EQ(o.volume, fraction(20, 3));
    // In a common frame, and in one that enlarges volumes eightfold.
    for (const Pose& frame : {Pose::from_quaternion({1, 2, 3, 4}, {0.1, 2, 3}),
                              Pose::from_doubles({0, -1, 0, .3, 1, 0, 0, 7, 0, 0, -1, 1e6})}) {
        const Overlap p = overlap(cube, frame, cube, frame * turn);
        EXPECT_TRUE(p.is_exact);
        EXPECT_EQ(p.volume, fraction(20, 3));
    }
    const Pose twice = Pose::from_doubles({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 1});
    EXPECT_EQ(overlap(cube, twice, cube, twice * turn).volume, fraction(160, 3));
}

TEST(Overlaps, SayWhenCornersWereRounded) {
    const auto ball = InterferenceModel(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    const double c = std::cos(1.0);
    const double s = std::sin(1.0);
    const Pose turn = Pose::from_doubles({c, -s, 0, 0.5, s, c, 0, 0, 0, 0, 1, 0});
    const Overlap o = overlap(ball, Pose(), ball, turn);
    EXPECT_FALSE(o.is_exact);
    EXPECT_GT(o.max_move, 0);
    EXPECT_LT(o.max_move, 1e-10);
    EXPECT_NEAR(o.volume.to_double(), overlap(ball, turn, ball, Pose()).volume.to_double(), 1e-9);
    EXPECT_FALSE(o.scaled_solid.is_empty());
}

// The notch is so small that its corners become one.
TEST(Overlaps, RoundingMayFlattenTriangles) {
    const double large = 0x1p40;
    const InterferenceModel notched(
        trisect::evaluate(box({0, 0, 0}, {large, large, large}).solid() -
                          box({-1, -1, -1}, {0x1p-20, 0x1p-20, 0x1p-20}).solid()));
    const auto cube = box({-large, -large, -large}, {large, large, large});
    const Overlap o = overlap(cube, Pose(), notched, Pose::from_quaternion({2, 0, 0, 1}));
    EXPECT_FALSE(o.is_exact);
    EXPECT_LT(o.max_move, 1);
    // One corner of the turned square is cut off, with a sixth of the area.
    EXPECT_NEAR(o.volume.to_double() / (large * large * large), 5.0 / 6, 1e-9);
}

TEST(Overlaps, OfRandomScenesFitTheirRelations) {
    int exact = 0;
    for (std::uint64_t seed = 9000; seed < 9200; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const InterferenceModel a(scene.a.solid());
        const InterferenceModel b(scene.b.solid());
        const Overlap o = overlap(a, scene.pose_a, b, scene.pose_b);
        const Overlap p = overlap(b, scene.pose_b, a, scene.pose_a);
        if (!o.is_exact || !p.is_exact) continue;
        ++exact;
        EXPECT_EQ(o.volume, p.volume) << "seed " << seed;
        const Relation r = interfere(a, scene.pose_a, b, scene.pose_b).relation;
        EXPECT_EQ(o.volume.sign() > 0, r != Relation::Disjoint && r != Relation::Touching)
            << "seed " << seed;
        if (r == Relation::Inside || r == Relation::Equal) {
            EXPECT_EQ(o.volume, overlap(a, scene.pose_a, a, scene.pose_a).volume)
                << "seed " << seed;
        }
    }
    EXPECT_GT(exact, 100);
}

}  // namespace
