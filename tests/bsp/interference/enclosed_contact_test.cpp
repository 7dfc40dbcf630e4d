// SPDX-License-Identifier: Apache-2.0
//
// First contact of enclosed motions: named configurations, the same motions as exact rational ones,
// and random solids whose times of contact are known exactly.

#include <trisect/bsp/interference/enclosed_contact.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/enclosed_motions.h"
#include "support/models.h"
#include "support/motion_oracle.h"

namespace {

using models::box;
using moving::straight;
using moving::whole;
using trisect::AlgebraicNumber;
using trisect::ConstantTurn;
using trisect::enclosed_first_contact;
using trisect::EnclosedContact;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::KeyFrame;
using trisect::Motion;
using trisect::Pose;
using trisect::Relation;
using trisect::Screw;
using trisect::Solid;
using trisect::UsageError;
using Outcome = EnclosedContact::Outcome;

EnclosedMotion quarter_turn(double duration = 1) {
    return EnclosedMotion::through(
        std::vector<KeyFrame>{{0, {1, 0, 0, 0}, {}}, {duration, {1, 0, 0, 1}, {}}});
}

EnclosedContact contact(const InterferenceModel& a, const InterferenceModel& b,
                        const EnclosedMotion& motion, double width = 1e-9) {
    return enclosed_first_contact(a, EnclosedMotion(), b, motion, {width});
}

// A narrow contact at a known time.
void expect_at(const EnclosedContact& c, double time, double width = 1e-9) {
    ASSERT_EQ(c.outcome, Outcome::Contact);
    EXPECT_TRUE(c.is_narrow);
    EXPECT_LE(c.free_until, time + 1e-13);
    EXPECT_GE(*c.contact_by, time - 1e-13);
    EXPECT_LE(*c.contact_by - c.free_until, width);
}

// An arm from the centre to the corner (3, 4) turns about z: the corner is on a circle of radius 5.
InterferenceModel arm() { return box(0, 0, 0, 3, 4, 1); }

TEST(EnclosedContact, ArmTurnsIntoAWall) {
    // The corner (3, 4) starts at 53.13 degrees and comes to y = 4.5 where its angle is asin(0.9).
    const double start = std::atan2(4., 3.);
    const double time = (std::asin(0.9) - start) / std::acos(0.);
    const EnclosedContact c = contact(box(-9, 4.5, -1, 9, 6, 2), arm(), quarter_turn());
    expect_at(c, time);
    ASSERT_EQ(c.witnesses.size(), 1U);
    expect_at(contact(box(-9, 4.5, -1, 9, 6, 2), arm(), quarter_turn(3)), 3 * time);
    expect_at(contact(box(-9, 4.5, -1, 9, 6, 2), arm(), quarter_turn(), 1e-3), time, 1e-3);
}

TEST(EnclosedContact, CornerGrazesAWallAtAnIrrationalTime) {
    // At 90 degrees the corner is at y = 5, the radius, and goes back.
    const double time = 1 - std::atan2(4., 3.) / std::acos(0.);
    const EnclosedContact graze = contact(box(-9, 5, -1, 9, 6, 2), arm(), quarter_turn());
    ASSERT_EQ(graze.outcome, Outcome::Undecided);
    EXPECT_LE(graze.free_until, time);
    EXPECT_GE(graze.free_until, time - 1e-5);
    EXPECT_GE(graze.undecided.back().to, time);
    EXPECT_LE(graze.undecided.back().to, time + 1e-2);
    EXPECT_FALSE(graze.is_narrow);
    // A little nearer and a little farther it is decided.
    const EnclosedContact miss = contact(box(-9, 5 + 0x1p-30, -1, 9, 6, 2), arm(), quarter_turn());
    EXPECT_EQ(miss.outcome, Outcome::None);
    EXPECT_TRUE(miss.undecided.empty());
    EXPECT_EQ(miss.free_until, 1);
    const EnclosedContact hit =
        contact(box(-9, 5 - 0x1p-20, -1, 9, 6, 2), arm(), quarter_turn(), 1e-8);
    expect_at(hit, (std::asin(1 - 0x1p-20 / 5) - std::atan2(4., 3.)) / std::acos(0.), 1e-8);
}

TEST(EnclosedContact, AlignedBlocksMeetFaceToFace) {
    // No edge passes through the inside of a face: a point inside both proves the contact.
    const EnclosedContact c =
        contact(box(0, 0, 0, 1, 1, 1), box(0, 0, 0, 1, 1, 1), straight({3, 0, 0}, {0.5, 0, 0}));
    expect_at(c, 0.8);
    EXPECT_TRUE(c.witnesses.empty());
    expect_at(
        contact(box(0, 0, 0, 4, 4, 1), box(0, 0, 0, 1, 1, 1), straight({1, 1, 3}, {1, 1, -1})),
        0.5);
}

TEST(EnclosedContact, BlockSlidesOnATable) {
    const EnclosedContact c =
        contact(box(0, 0, 0, 9, 9, 1), box(0, 0, 0, 1, 1, 1), straight({1, 1, 1}, {5, 5, 1}));
    ASSERT_EQ(c.outcome, Outcome::Undecided);
    EXPECT_EQ(c.free_until, 0);
    EXPECT_EQ(c.undecided, (std::vector<trisect::TimeSpan>{{0, 1}}));
}

TEST(EnclosedContact, BlockIsLiftedFromATable) {
    const EnclosedContact c =
        contact(box(0, 0, 0, 9, 9, 1), box(0, 0, 0, 1, 1, 1), straight({1, 1, 1}, {1, 1, 4}));
    ASSERT_EQ(c.outcome, Outcome::Undecided);
    EXPECT_EQ(c.free_until, 0);
    ASSERT_EQ(c.undecided.size(), 1U);
    EXPECT_LT(c.undecided[0].to, 1e-9);
}

TEST(EnclosedContact, BlockIsLiftedAndPutDownInto) {
    // Resting, in the air, and half a unit into the table.
    const EnclosedMotion motion =
        EnclosedMotion::through(std::vector<KeyFrame>{{0, {1, 0, 0, 0}, {1, 1, 1}},
                                                      {1, {1, 0, 0, 0}, {1, 1, 2}},
                                                      {2, {1, 0, 0, 0}, {1, 1, 0.5}}});
    const EnclosedContact c = contact(box(0, 0, 0, 9, 9, 1), box(0, 0, 0, 1, 1, 1), motion);
    ASSERT_EQ(c.outcome, Outcome::Contact);
    EXPECT_FALSE(c.is_narrow);  // it may touch at the start
    EXPECT_EQ(c.free_until, 0);
    EXPECT_NEAR(*c.contact_by, 1 + 2. / 3, 2e-3);
    ASSERT_EQ(c.undecided.size(), 2U);
    EXPECT_LT(c.undecided[0].to, 1e-9);
}

TEST(EnclosedContact, SolidsThatOverlapAtTheStart) {
    const EnclosedContact c =
        contact(box(0, 0, 0, 4, 4, 4), box(0, 0, 0, 1, 1, 9), straight({1, 1, 1}, {9, 9, 9}));
    ASSERT_EQ(c.outcome, Outcome::Contact);
    EXPECT_EQ(c.free_until, 0);
    EXPECT_EQ(c.contact_by, 0);
    EXPECT_TRUE(c.is_narrow);
}

TEST(EnclosedContact, SolidWithinAnotherFromTheStart) {
    const auto inside = contact(box(0, 0, 0, 9, 9, 9), box(0, 0, 0, 1, 1, 1), quarter_turn());
    ASSERT_EQ(inside.outcome, Outcome::Contact);  // they share a corner
    EXPECT_EQ(inside.contact_by, 0);
    const auto deep = contact(box(-9, -9, -9, 9, 9, 9), box(0, 0, 0, 1, 1, 1), quarter_turn());
    ASSERT_EQ(deep.outcome, Outcome::Contact);
    EXPECT_EQ(deep.contact_by, 0);
    const auto around = contact(box(0, 0, 0, 1, 1, 1), box(-9, -9, -9, 9, 9, 9), quarter_turn());
    ASSERT_EQ(around.outcome, Outcome::Contact);
    EXPECT_EQ(around.contact_by, 0);
    // In a cavity it is outside.
    const Solid room =
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_box({-9, -9, -9}, {9, 9, 9}))) -
                 trisect::Expression(Solid::from_mesh(trisect::make_box({-4, -4, -4}, {4, 4, 4}))));
    EXPECT_EQ(contact(InterferenceModel(room), box(0, 0, 0, 1, 1, 1), quarter_turn()).outcome,
              Outcome::None);
}

TEST(EnclosedContact, ManyTurnsOfARingInAGroove) {
    // A torus turns about its own axis in a ring that leaves a hundredth of its size: none, proved.
    const auto ring = InterferenceModel(Solid::from_mesh(trisect::make_torus(4, 0.5, 24, 8)));
    ConstantTurn turn;
    turn.angle = 7;
    const auto plate = box(-6, -6, -2, 6, 6, -0.51);
    EXPECT_EQ(contact(plate, ring, EnclosedMotion::turning(Pose(), turn)).outcome, Outcome::None);
    // Falling slowly on the way it lands.
    turn.shift = {0, 0, -0.1};
    const EnclosedContact c = contact(plate, ring, EnclosedMotion::turning(Pose(), turn), 1e-6);
    ASSERT_NE(c.outcome, Outcome::None);
    EXPECT_NEAR(c.free_until, 0.1, 0.01);
}

TEST(EnclosedContact, BothMove) {
    // Two arms turn towards each other about the same axis.
    const EnclosedMotion back = EnclosedMotion::through(
        std::vector<KeyFrame>{{0, {1, 0, 0, 0}, {}}, {1, {1, 0, 0, -1}, {}}});
    // Sides y = 0 of the one at 0 degrees and x = 0 of the other one at 90 degrees before turning.
    const auto one = box(1, 0, 0, 9, 1, 1);
    const auto other = box(0, 1, 0, 1, 9, 1);
    // Points (9, 1) and (1, 9) at atan(1/9) and 90 - atan(1/9) degrees approach at twice the speed.
    const double gap = std::acos(0.) - 2 * std::atan2(1., 9.);
    const EnclosedContact c = enclosed_first_contact(one, quarter_turn(), other, back, {1e-9});
    ASSERT_EQ(c.outcome, Outcome::Contact);
    EXPECT_LE(c.free_until, gap / 2 / std::acos(0.));
    const EnclosedContact mirrored =
        enclosed_first_contact(other, back, one, quarter_turn(), {1e-9});
    ASSERT_EQ(mirrored.outcome, Outcome::Contact);
    EXPECT_NEAR(*mirrored.contact_by, *c.contact_by, 1e-8);
}

TEST(EnclosedContact, WhatMakesNoSenseIsRefused) {
    const auto cube = box(0, 0, 0, 1, 1, 1);
    EXPECT_THROW(contact(cube, cube, quarter_turn(), 0), UsageError);
    EXPECT_THROW((void)enclosed_first_contact(cube, quarter_turn(2), cube, quarter_turn()),
                 UsageError);
    const EnclosedContact none = contact(cube, InterferenceModel(), quarter_turn());
    EXPECT_EQ(none.outcome, Outcome::None);
    EXPECT_EQ(none.free_until, 1);
}

// The same geometric motion, as a rational screw and as one of constant angular speed: what comes
// first in one comes first in the other, and the parameter says where the time must be.
TEST(EnclosedContact, ConstantSpeedAndRationalScrewsMeetAtTheSamePlace) {
    reference::Random random(11);
    int contacts = 0;
    for (int round = 0; round < 150; ++round) {
        const auto operand_a = reference::random_embedded_solid(random);
        const auto operand_b = reference::random_embedded_solid(random);
        const InterferenceModel a{engines::solid(operand_a)};
        const InterferenceModel b{engines::solid(operand_b)};
        Screw screw;
        screw.turn = {random.between(1, 4), random.between(-4, 4), random.between(-4, 4),
                      random.between(-4, 4)};
        if (screw.turn[1] == 0 && screw.turn[2] == 0 && screw.turn[3] == 0) continue;
        screw.center = {whole(random, -4, 4), whole(random, -4, 4), 0};
        const Pose start = Pose::from_translation({whole(random, 8, 10), 1, 1});
        const FirstContact exact = first_contact(a, Motion(), b, Motion::screw(start, screw));
        ConstantTurn turn;
        turn.axis = {double(screw.turn[1]), double(screw.turn[2]), double(screw.turn[3])};
        const double tangent = std::hypot(turn.axis[0], turn.axis[1], turn.axis[2]) /
                               static_cast<double>(screw.turn[0]);
        turn.angle = 2 * std::atan(tangent);
        turn.center = screw.center;
        const EnclosedContact c = contact(a, b, EnclosedMotion::turning(start, turn), 1e-8);
        if (!exact.exists()) {
            EXPECT_NE(c.outcome, Outcome::Contact) << round;
            continue;
        }
        ++contacts;
        const double time = 2 * std::atan(exact.time->to_double() * tangent) / turn.angle;
        EXPECT_NE(c.outcome, Outcome::None) << round;
        EXPECT_LE(c.free_until, time + 1e-13) << round;
        if (c.contact_by) {
            EXPECT_GE(*c.contact_by, time - 1e-13) << round;
        }
    }
    EXPECT_GT(contacts, 20);
}

// Rational motions through the search for enclosed ones, where the exact answer is known: every
// claim holds, and what is undecided is a contact without a crossing.
TEST(EnclosedContact, ClaimsAboutRationalMotionsHold) {
    reference::Random random(12);
    std::array<int, 3> outcomes{};
    int narrow = 0;
    for (int round = 0; round < 300; ++round) {
        const InterferenceModel a{engines::solid(reference::random_embedded_solid(random))};
        const InterferenceModel b{engines::solid(reference::random_embedded_solid(random))};
        oracle::Placement p;
        p.quaternion = {random.between(1, 2), random.between(-1, 1), random.between(-1, 1), 0};
        p.at = {whole(random, 9, 12), whole(random, -1, 1), whole(random, -1, 1)};
        p.screw.turn = {random.between(2, 4), random.between(-1, 1), random.between(-1, 1),
                        random.between(-2, 2)};
        p.screw.shift = {whole(random, -20, 0), whole(random, -1, 1), 0};
        const FirstContact exact = first_contact(a, Motion(), b, p.motion());
        const EnclosedContact c = contact(a, b, EnclosedMotion(p.motion()));
        ++outcomes[static_cast<std::size_t>(c.outcome)];
        narrow += c.is_narrow ? 1 : 0;
        if (c.outcome == Outcome::None) {
            EXPECT_FALSE(exact.exists()) << round;
            continue;
        }
        if (exact.exists()) {
            EXPECT_GE(*exact.time, AlgebraicNumber(ExactRational::from_double(c.free_until)));
        }
        if (c.outcome == Outcome::Contact) {
            ASSERT_TRUE(exact.exists()) << round;
            EXPECT_LE(*exact.time, AlgebraicNumber(ExactRational::from_double(*c.contact_by)));
            const auto relation =
                interfere(a, Pose(), b,
                          p.motion().pose_at(ExactRational::from_double(*c.contact_by)))
                    .relation;
            EXPECT_NE(relation, Relation::Disjoint) << round;
            EXPECT_NE(relation, Relation::Touching) << round;
        } else if (exact.exists()) {
            bool is_within = false;
            for (const trisect::TimeSpan& s : c.undecided)
                is_within = is_within ||
                            (*exact.time >= AlgebraicNumber(ExactRational::from_double(s.from)) &&
                             *exact.time <= AlgebraicNumber(ExactRational::from_double(s.to)));
            EXPECT_TRUE(is_within) << round;
        }
    }
    EXPECT_GT(outcomes[0], 10);
    EXPECT_GT(outcomes[1], 60);
    EXPECT_GT(narrow, outcomes[1] / 2);
    RecordProperty("narrow", narrow);
    RecordProperty("undecided", outcomes[2]);
}

// Slerp has no exact times; sampled densely in doubles, which are poses of their own.
TEST(EnclosedContact, SamplesOfSlerpsAgree) {
    reference::Random random(13);
    int sampled = 0;
    for (int round = 0; round < 40; ++round) {
        const InterferenceModel a{engines::solid(reference::random_embedded_solid(random))};
        const InterferenceModel b{engines::solid(reference::random_embedded_solid(random))};
        std::vector<KeyFrame> frames;
        for (int i = 0; i < 3; ++i)
            frames.push_back({double(i),
                              {whole(random, 1, 3), whole(random, -2, 2), whole(random, -2, 2),
                               whole(random, -2, 2)},
                              {i == 1 ? 2. : whole(random, 12, 20), whole(random, -5, 5),
                               whole(random, -3, 3)}});
        const EnclosedMotion motion = EnclosedMotion::through(frames);
        const EnclosedContact c = contact(a, b, motion);
        for (int i = 0; i <= 64; ++i) {
            const double t = 2 * i / 64.;
            if (t >= c.free_until - 1e-6) break;
            const Pose pose =
                Pose::from_doubles(motion.enclose(t, t).motion.approximate_pose_at(0));
            EXPECT_EQ(interfere(a, Pose(), b, pose).relation, Relation::Disjoint) << round;
            ++sampled;
        }
        if (!c.contact_by) continue;
        const Pose pose = Pose::from_doubles(
            motion.enclose(*c.contact_by, *c.contact_by).motion.approximate_pose_at(0));
        EXPECT_NE(interfere(a, Pose(), b, pose).relation, Relation::Disjoint) << round;
    }
    EXPECT_GT(sampled, 100);
}

}  // namespace
