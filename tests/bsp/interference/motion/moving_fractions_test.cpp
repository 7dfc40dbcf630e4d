// SPDX-License-Identifier: Apache-2.0
//
// Moving solids whose coordinates have bits behind the point: times, relations and witnesses are
// those of the same solids without.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference.h>

#include "support/enclosed_motions.h"
#include "support/fraction_models.h"
#include "support/gmp_oracle.h"
#include "support/models.h"
#include "support/moving_pair.h"
#include "support/pose_oracle.h"

namespace {

using trisect::ContactEvent;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Relation;
using trisect::test::model_in_units_of;
using trisect::test::with_fractions;

constexpr std::array<std::array<int, 2>, 5> both_bits{
    {{8, 0}, {0, 24}, {56, 56}, {70, 3}, {24, 66}}};

TEST(MovingFractions, FirstContactsAreThoseOfWholeSolids) {
    std::array<int, 2> events{};
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const moving::Pair pair = moving::random_pair(seed);
        const auto& bits = both_bits[seed % both_bits.size()];
        const InterferenceModel a = with_fractions(pair.a, bits[0]);
        const InterferenceModel b = with_fractions(pair.b, bits[1]);
        for (const auto event : {ContactEvent::Touch, ContactEvent::Overlap}) {
            trisect::FirstContactOptions options;
            options.event = event;
            const auto whole = first_contact(pair.a, pair.motion_a, pair.b, pair.motion_b, options);
            options.leave_out_receding = seed % 2 == 0;
            const auto found = first_contact(a, pair.motion_a, b, pair.motion_b, options);
            EXPECT_EQ(found.at_start, whole.at_start) << "seed " << seed;
            ASSERT_EQ(found.exists(), whole.exists()) << "seed " << seed;
            if (!found.exists()) continue;
            EXPECT_TRUE(*found.time == *whole.time) << "seed " << seed;
            EXPECT_EQ(found.witnesses.size(), whole.witnesses.size()) << "seed " << seed;
            ++events[event == ContactEvent::Touch ? 0 : 1];
        }
    }
    EXPECT_GT(events[0], 10);
    EXPECT_GT(events[1], 10);
}

TEST(MovingFractions, EnclosedMotionsEndWhereThoseOfWholeSolidsDo) {
    int contacts = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const moving::Pair pair = moving::random_pair(seed);
        const auto& bits = both_bits[seed % both_bits.size()];
        const EnclosedMotion motion_a(pair.motion_a);
        const EnclosedMotion motion_b(pair.motion_b);
        const auto whole = enclosed_first_contact(pair.a, motion_a, pair.b, motion_b, {1e-6});
        const auto found =
            enclosed_first_contact(with_fractions(pair.a, bits[0]), motion_a,
                                   with_fractions(pair.b, bits[1]), motion_b, {1e-6});
        EXPECT_EQ(found.outcome, whole.outcome) << "seed " << seed;
        EXPECT_NEAR(found.free_until, whole.free_until, 2e-6) << "seed " << seed;
        contacts += found.contact_by ? 1 : 0;
    }
    EXPECT_GT(contacts, 3);
}

// A ball of doubles as they come falls onto a box whose upper side is such a double, too: the time
// is a fraction of them.
TEST(MovingFractions, AWideBallTouchesAFloorWhenItsLowestVertexDoes) {
    oracle::Source random(8);
    for (int round = 0; round < 10; ++round) {
        PolygonMesh ball = trisect::make_icosphere(1, 1);
        const double angle = oracle::real(random, 3);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        double lowest = 0;
        for (auto& p : ball.points) {
            const std::array<double, 3> q = p;
            p = {q[0], c * q[1] - s * q[2], s * q[1] + c * q[2]};
            lowest = std::min(lowest, p[2]);
        }
        const double top = -3 + std::abs(oracle::real(random, 1));
        const InterferenceModel floor =
            model_in_units_of(trisect::make_box({-2, -2, -4}, {2, 2, top}), -40 - round % 5);
        const InterferenceModel falling = model_in_units_of(ball, -45);
        const double way = -5;
        const auto contact =
            first_contact(floor, Motion(), falling, Motion::translation(Pose(), {0.1, 0.3, way}));
        ASSERT_TRUE(contact.exists());
        const ExactRational time =
            (ExactRational::from_double(top) - ExactRational::from_double(lowest)) /
            ExactRational::from_double(way);
        EXPECT_TRUE(*contact.time == trisect::AlgebraicNumber(time)) << round;
        // Just there they touch.
        const Motion motion = Motion::translation(Pose(), {0.1, 0.3, way});
        EXPECT_EQ(interfere(floor, Pose(), falling, motion.pose_at(time)).relation,
                  Relation::Touching);
    }
}

// Flush slides along a wall at 0.3 are no contact event for Overlap, and end at a wall of its own.
TEST(MovingFractions, ABoxSlidesAlongAWallOnAnotherLattice) {
    const InterferenceModel box =
        model_in_units_of(trisect::make_box({0, 0, 0}, {0.3, 0.3, 0.3}), -46);
    const InterferenceModel wall =
        model_in_units_of(trisect::make_box({0.3, -5, -5}, {900, 5, 5}), -35);
    const InterferenceModel stop =
        model_in_units_of(trisect::make_box({-9, 1.1, -5}, {9, 2, 5}), -41);
    const Motion along = Motion::translation(Pose(), {0, 2, 0});
    trisect::FirstContactOptions options;
    options.event = ContactEvent::Overlap;
    EXPECT_FALSE(first_contact(wall, Motion(), box, along, options).exists());
    const auto touch = first_contact(wall, Motion(), box, along);
    ASSERT_TRUE(touch.exists());
    EXPECT_EQ(touch.at_start, Relation::Touching);
    const auto end = first_contact(stop, Motion(), box, along, options);
    ASSERT_TRUE(end.exists());
    EXPECT_TRUE(*end.time == trisect::AlgebraicNumber((ExactRational::from_double(1.1) -
                                                       ExactRational::from_double(0.3)) /
                                                      ExactRational(2)));
    // Towards the wall every shift is an overlap at once, away from it none ever.
    const auto into =
        first_contact(wall, Motion(), box, Motion::translation(Pose(), {0x1p-60, 0, 0}), options);
    ASSERT_TRUE(into.exists());
    EXPECT_TRUE(*into.time == trisect::AlgebraicNumber(ExactRational()));
    EXPECT_FALSE(
        first_contact(wall, Motion(), box, Motion::translation(Pose(), {-0x1p-60, 0, 0}), options)
            .exists());
}

}  // namespace
