// SPDX-License-Identifier: Apache-2.0
//
// The least distance along motions: known ones, and many exact distances at times on the way.

#include <trisect/bsp/interference/least_distance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/enclosed_motions.h"
#include "support/motion_oracle.h"
#include "support/solids.h"

namespace least_distance_test {
namespace {

using moving::whole;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::LeastDistance;
using trisect::LeastDistanceOptions;
using trisect::Motion;
using trisect::Pose;
using trisect::Solid;

ExactRational squared(double v) {
    return ExactRational::from_double(v) * ExactRational::from_double(v);
}

// Exact distances at some times are not below the bound, and the one at its time not above it.
void expect_right(const Solid& a, const Motion& motion_a, const Solid& b, const Motion& motion_b,
                  int times, const LeastDistanceOptions& options = {}) {
    const auto found = least_distance(a, motion_a, b, motion_b, options);
    ASSERT_TRUE(found.has_value());
    EXPECT_LE(found->lower, found->upper);
    EXPECT_TRUE(found->is_narrow);
    EXPECT_LE(found->upper - found->lower, std::max(options.relative * found->upper, 1e-9));
    const auto exact_at = [&](const ExactRational& t) {
        const auto at = [&t](const Motion& m) {
            return m.is_still() ? m.pose_at(ExactRational()) : m.pose_at(t);
        };
        return *exact_squared_distance(a, at(motion_a), b, at(motion_b));
    };
    EXPECT_LE(exact_at(ExactRational::from_double(found->time)), squared(found->upper));
    const auto last =
        static_cast<std::int64_t>(std::max(motion_a.piece_count(), motion_b.piece_count()));
    for (std::int64_t i = 0; i <= times; ++i) {
        const ExactRational t = ExactRational(i * last) / ExactRational(times);
        EXPECT_GE(exact_at(t), squared(found->lower)) << i;
    }
}

TEST(LeastDistance, ACornerPassesAFace) {
    // The lower corners of the cube pass 1 above the plate, in the middle of the way.
    const Solid plate = solids::box(0, 0, 0, 9, 9, 1);
    const Solid cube = solids::box(0, 0, 0, 1, 1, 1);
    const Motion down = Motion::translation(Pose::from_translation({1, 1, 4}), {3, 3, -2});
    const Motion up = Motion::translation(Pose::from_translation({4, 4, 2}), {3, 3, 5});
    const auto found = least_distance(plate, Motion(), cube, down.then(up));
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->is_narrow);
    EXPECT_LE(found->lower, 1);
    EXPECT_GE(found->upper, 1);
    EXPECT_LE(found->upper - found->lower, 1e-6);
    EXPECT_NEAR(found->time, 1, 1e-5);
    EXPECT_EQ(found->a.kind, trisect::EntityName::Kind::Face);
    EXPECT_NEAR(found->on_a[2], 1, 1e-9);
    EXPECT_NEAR(found->on_b[2], 2, 1e-5);
}

TEST(LeastDistance, ATurningBarIsNearestInTheMiddle) {
    // Its end is on a circle of radius √17 about the origin.
    const Solid bar = solids::box(0, -1, 0, 4, 1, 1);
    const Solid wall = solids::box(5, -9, 0, 6, 9, 1);
    const EnclosedMotion turn = EnclosedMotion::turning(Pose::from_quaternion({3, 0, 0, -1}),
                                                        {{0, 0, 1}, 3.0, {0, 0, 0}, {0, 0, 0}});
    LeastDistanceOptions options;
    options.relative = 1e-8;
    const auto found = least_distance(wall, EnclosedMotion(), bar, turn, options);
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->is_narrow);
    EXPECT_LE(found->lower, 5 - std::sqrt(17.0) + 1e-15);
    EXPECT_GE(found->upper, 5 - std::sqrt(17.0) - 1e-15);
    EXPECT_LE(found->upper - found->lower, 1e-8);
}

TEST(LeastDistance, APegThatSlidesInItsHoleIsAsNearAllTheTime) {
    const Solid hole = evaluate(solids::box(-3, -3, 0, 3, 3, 4) -
                                Solid::from_mesh(trisect::make_cylinder(1.25, 6, 24)));
    const Solid peg = Solid::from_mesh(trisect::make_cylinder(1.125, 9, 24));
    const Motion down = Motion::translation(Pose::from_translation({0, 0, -2}), {0, 0, -2});
    expect_right(hole, Motion(), peg, down, 3);
    expect_right(peg, down, hole, Motion(), 1);
    // Both turn by the same: nothing changes.
    const Motion turn = Motion::screw(Pose(), {{3, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}});
    expect_right(hole, turn, peg, turn, 2, {1e-3, 0});
}

TEST(LeastDistance, ThroughEachOtherTouchingAndEmpty) {
    const Solid cube = solids::box(0, 0, 0, 1, 1, 1);
    const Motion through = Motion::translation(Pose::from_translation({-5, 0.25, 0.5}), {9, 0, 0});
    const auto crossing = least_distance(cube, Motion(), cube, through);
    EXPECT_EQ(crossing->lower, 0);
    EXPECT_EQ(crossing->upper, 0);
    EXPECT_TRUE(crossing->is_narrow);
    const auto sliding = least_distance(
        cube, Motion(), cube, Motion::translation(Pose::from_translation({-5, 0, 1}), {9, 0, 0}));
    EXPECT_EQ(sliding->lower, 0);
    EXPECT_LE(sliding->upper, 1e-12);
    EXPECT_TRUE(sliding->is_narrow);
    EXPECT_FALSE(least_distance(cube, Motion(), Solid(), Motion()).has_value());
    const auto still =
        least_distance(cube, Motion(), cube, Motion(Pose::from_translation({4, 0, 0})));
    EXPECT_NEAR(still->lower, 3, 1e-5);
    EXPECT_GE(still->upper, 3);
    EXPECT_THROW((void)least_distance(cube, Motion(), cube, through, {0.0, 0}),
                 trisect::UsageError);
    EXPECT_THROW((void)least_distance(cube, Motion(), cube, through, {0.5, -1}),
                 trisect::UsageError);
}

TEST(LeastDistance, OfRandomSolidsIsBelowExactDistancesOnTheWay) {
    reference::Random random(31);
    for (int round = 0; round < 24; ++round) {
        SCOPED_TRACE(round);
        const Solid a = engines::solid(reference::random_embedded_solid(random));
        const Solid b = engines::solid(reference::random_embedded_solid(random));
        oracle::Placement p;
        p.quaternion = {random.between(1, 2), random.between(-1, 1), random.between(-1, 1), 0};
        p.at = {whole(random, 9, 14), whole(random, -6, 6), whole(random, -6, 6)};
        p.screw.turn = {random.between(2, 4), random.between(-1, 1), random.between(-1, 1),
                        random.between(-2, 2)};
        p.screw.shift = {whole(random, -6, 0), whole(random, -1, 1), whole(random, -3, 3)};
        if (round % 2 == 0) {
            expect_right(a, Motion(), b, p.motion(), 16);
        } else {
            // A turns as well; a pose that stretches.
            const Motion other =
                round % 4 == 1
                    ? Motion::screw(Pose(), {{5, 1, 0, 1}, {0, 0, 0}, {-3, 0, 0}})
                    : Motion::translation(
                          Pose::from_doubles({2, 1, 0, -9, 0, 1, 0, 0, 0, 0, 0.25, 0}), {0, 3, 0});
            expect_right(a, other, b, p.motion(), 16, {1e-3, 0});
        }
    }
}

}  // namespace
}  // namespace least_distance_test
