// SPDX-License-Identifier: Apache-2.0
//
// First contact of solids on their own trees under enclosed motions, whose exact times are known or
// are those of models.

#include <trisect/bsp/interference/solid_motion.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/enclosed_motions.h"
#include "support/motion_oracle.h"
#include "support/solids.h"

namespace {

using moving::straight;
using moving::whole;
using trisect::AlgebraicNumber;
using trisect::enclosed_first_contact;
using trisect::EnclosedMotion;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::ExactRational;
using trisect::Expression;
using trisect::first_contact;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::NamedEnclosedContact;
using trisect::NamedFirstContact;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using Outcome = NamedEnclosedContact::Outcome;

NamedEnclosedContact contact(const Solid& a, const Solid& b, const EnclosedMotion& motion) {
    return enclosed_first_contact(a, EnclosedMotion(), b, motion);
}

void expect_at(const NamedEnclosedContact& c, double time) {
    ASSERT_EQ(c.outcome, Outcome::Contact);
    EXPECT_TRUE(c.is_narrow);
    EXPECT_LE(c.free_until, time + 1e-13);
    EXPECT_GE(*c.contact_by, time - 1e-13);
}

Solid random_solid(reference::Random& random, std::uint32_t leaf_polygons) {
    const Solid s = engines::solid(reference::random_embedded_solid(random));
    EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    return evaluate(Expression(s) - Expression(solids::box(2, 2, 2, 5, 4, 9)), options);
}

TEST(SolidEnclosedContact, FacesThatPassThroughEachOther) {
    const Solid wall = solids::box(4, -9, -9, 5, 9, 9);
    const Solid tip =
        engines::solid(reference::tetrahedron({2, 0, 0}, {0, -1, -1}, {0, 1, -1}, {0, 0, 1}));
    const NamedEnclosedContact c = contact(wall, tip, straight({0, 0, 0}, {4, 0, 0}));
    expect_at(c, 0.5);
    ASSERT_EQ(c.witnesses.size(), 1U);
    EXPECT_EQ(c.witnesses[0].a.kind, trisect::EntityName::Kind::Face);
    EXPECT_EQ(c.witnesses[0].a.faces[0].operand, wall.source_id());
    EXPECT_EQ(c.witnesses[0].b.faces[0].operand, tip.source_id());
}

TEST(SolidEnclosedContact, AlignedBlocksMeetFaceToFace) {
    const NamedEnclosedContact c =
        contact(solids::box(0, 1), solids::box(0, 1), straight({3, 0, 0}, {0.5, 0, 0}));
    expect_at(c, 0.8);
    EXPECT_TRUE(c.witnesses.empty());
}

TEST(SolidEnclosedContact, NothingIsProvedOfSliding) {
    const NamedEnclosedContact c =
        contact(solids::box(0, 0, 0, 9, 9, 1), solids::box(0, 1), straight({1, 1, 1}, {5, 5, 1}));
    EXPECT_EQ(c.outcome, Outcome::Undecided);
    EXPECT_EQ(c.free_until, 0);
    EXPECT_EQ(c.undecided, (std::vector<trisect::TimeSpan>{{0, 1}}));
}

TEST(SolidEnclosedContact, WithinAndEmpty) {
    const EnclosedMotion motion = straight({1, 1, 1}, {2, 1, 1});
    const NamedEnclosedContact within = contact(solids::box(0, 9), solids::box(0, 1), motion);
    EXPECT_EQ(within.outcome, Outcome::Contact);
    EXPECT_EQ(within.contact_by, 0);
    const NamedEnclosedContact empty = contact(solids::box(0, 9), Solid(), motion);
    EXPECT_EQ(empty.outcome, Outcome::None);
    EXPECT_EQ(empty.free_until, 1);
    EXPECT_THROW(
        (void)enclosed_first_contact(solids::box(0, 9), motion, solids::box(0, 1), motion, {0.0}),
        trisect::UsageError);
}

// Rational motions through the search for enclosed ones: every claim holds of the exact time, and
// models say the same but for what is undecided.
TEST(SolidEnclosedContact, ClaimsAboutRationalMotionsHold) {
    reference::Random random(12);
    std::array<int, 3> outcomes{};
    for (int round = 0; round < 120; ++round) {
        SCOPED_TRACE(round);
        const auto few = static_cast<std::uint32_t>(1 + round % 6);
        const Solid a = random_solid(random, few);
        const Solid b = random_solid(random, few);
        oracle::Placement p;
        p.quaternion = {random.between(1, 2), random.between(-1, 1), random.between(-1, 1), 0};
        p.at = {whole(random, 9, 12), whole(random, -1, 1), whole(random, -1, 1)};
        p.screw.turn = {random.between(2, 4), random.between(-1, 1), random.between(-1, 1),
                        random.between(-2, 2)};
        p.screw.shift = {whole(random, -20, 0), whole(random, -1, 1), 0};
        const NamedFirstContact exact = first_contact(a, Motion(), b, p.motion());
        const NamedEnclosedContact c = contact(a, b, EnclosedMotion(p.motion()));
        EXPECT_EQ(c.outcome,
                  enclosed_first_contact(InterferenceModel(a), EnclosedMotion(),
                                         InterferenceModel(b), EnclosedMotion(p.motion()))
                      .outcome);
        ++outcomes[static_cast<std::size_t>(c.outcome)];
        if (c.outcome == Outcome::None) {
            EXPECT_FALSE(exact.exists());
        }
        if (exact.exists()) {
            EXPECT_GE(*exact.time, AlgebraicNumber(ExactRational::from_double(c.free_until)));
        }
        if (c.outcome == Outcome::Contact) {
            ASSERT_TRUE(exact.exists());
            EXPECT_LE(*exact.time, AlgebraicNumber(ExactRational::from_double(*c.contact_by)));
        }
    }
    EXPECT_GT(outcomes[0], 5);
    EXPECT_GT(outcomes[1], 20);
}

}  // namespace
