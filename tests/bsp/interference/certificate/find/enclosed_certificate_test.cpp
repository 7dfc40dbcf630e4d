// SPDX-License-Identifier: Apache-2.0
//
// Certificates of contact under enclosed motions: those of random scenes are accepted, corrupted
// ones are not.

#include <trisect/bsp/interference/enclosed_certificate.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <trisect/brep/primitives/torus.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/enclosed_motions.h"
#include "support/models.h"
#include "support/reason.h"

namespace enclosed_certificate_test {
namespace {

using models::box;
using moving::straight;
using moving::whole;
using trisect::certify_enclosed_contact;
using trisect::ConstantTurn;
using trisect::EnclosedCertificate;
using trisect::EnclosedContact;
using trisect::EnclosedFreedomNode;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::KeyFrame;
using trisect::Pose;
using trisect::Solid;
using Outcome = EnclosedContact::Outcome;

struct Case {
    InterferenceModel a;
    EnclosedMotion motion_a;
    InterferenceModel b;
    EnclosedMotion motion_b;
    double width = 1e-9;

    [[nodiscard]] EnclosedCertificate certificate() const {
        return certify_enclosed_contact(a, motion_a, b, motion_b, {width});
    }
    [[nodiscard]] std::string check(const EnclosedCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), motion_a, b.brep(), motion_b));
    }
};

EnclosedMotion quarter_turn() {
    return EnclosedMotion::through(
        std::vector<KeyFrame>{{0, {1, 0, 0, 0}, {}}, {1, {1, 0, 0, 1}, {}}});
}

void expect_proved(const Case& c, Outcome outcome) {
    const EnclosedCertificate certificate = c.certificate();
    EXPECT_EQ(certificate.answer.outcome, outcome);
    EXPECT_TRUE(certificate.is_complete);
    EXPECT_EQ(c.check(certificate), "");
}

TEST(EnclosedCertificates, OfNamedConfigurations) {
    const auto arm = box(0, 0, 0, 3, 4, 1);
    const EnclosedMotion still;
    expect_proved({box(-9, 4.5, -1, 9, 6, 2), still, arm, quarter_turn()}, Outcome::Contact);
    expect_proved({box(-9, 5.5, -1, 9, 6, 2), still, arm, quarter_turn()}, Outcome::None);
    expect_proved({box(-9, 5 + 0x1p-20, -1, 9, 6, 2), still, arm, quarter_turn()}, Outcome::None);
    // Sliding on the wall can be neither proved nor excluded.
    expect_proved({box(-9, 4, 0, 9, 6, 1), still, arm, straight({0, 0, 0}, {1, 0, 0})},
                  Outcome::Undecided);
    // Aligned blocks, one in the other at the start, and both moving.
    const auto unit = box(0, 0, 0, 1, 1, 1);
    expect_proved({unit, still, unit, straight({3, 0, 0}, {0.5, 0, 0})}, Outcome::Contact);
    expect_proved({box(-4, -4, -4, 4, 4, 4), still, unit, straight({0, 0, 0}, {1, 0, 0})},
                  Outcome::Contact);
    expect_proved({arm, quarter_turn(), unit, straight({-8, 3, 0}, {0, 1, 0})}, Outcome::Contact);
    expect_proved({arm, quarter_turn(), unit, straight({8, 8, 0}, {6, -6, 0})}, Outcome::None);
}

TEST(EnclosedCertificates, OfLinkedRings) {
    const auto ring = InterferenceModel(Solid::from_mesh(trisect::make_torus(3, 0.75, 12, 6)));
    ConstantTurn turn;
    turn.axis = {1, 1, 1};
    turn.angle = 0.5;
    turn.center = {3, 0, 0};
    const Pose link = Pose::from_quaternion({1, 1, 0, 0}, {3, 0, 0});
    expect_proved({ring, EnclosedMotion(), ring, EnclosedMotion::turning(link, turn), 1e-6},
                  Outcome::None);
    turn.shift = {2, 0, 0};
    expect_proved({ring, EnclosedMotion(), ring, EnclosedMotion::turning(link, turn), 1e-6},
                  Outcome::Contact);
}

// Sliding on a wall: only what is ordered, and certainly a number, is a time.
TEST(EnclosedCertificates, UndecidedTimesAreSpans) {
    const Case c{box(-9, 4, 0, 9, 6, 1), EnclosedMotion(), box(0, 0, 0, 3, 4, 1),
                 straight({0, 0, 0}, {1, 0, 0})};
    EnclosedCertificate certificate = c.certificate();
    ASSERT_TRUE(certificate.is_complete);
    ASSERT_EQ(c.check(certificate), "");
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const trisect::TimeSpan& span :
         {trisect::TimeSpan{none, 1}, {0, none}, {none, none}, {1, 0}}) {
        certificate.answer.undecided = {span};
        EXPECT_EQ(c.check(certificate), "an undecided span is none");
    }
    certificate.answer.undecided = {{0, 0.5}, {0.25, 1}};
    EXPECT_EQ(c.check(certificate), "");
    certificate.answer.undecided = {{0, 0.5}, {0.75, 1}};
    EXPECT_EQ(c.check(certificate), "times are missing");
}

// Solids on a small grid, key frames with slerp or constant turns.
Case random_case(std::uint64_t seed) {
    reference::Random random(seed);
    const auto solid = [&random] {
        return InterferenceModel(engines::solid(reference::random_embedded_solid(random)));
    };
    Case c{solid(), EnclosedMotion(), solid(), EnclosedMotion(), 1e-7};
    if (random.chance(1, 3)) {
        ConstantTurn turn;
        turn.axis = {whole(random, -2, 2), whole(random, -2, 2), 1};
        turn.angle = whole(random, -8, 8) / 4;
        turn.center = {whole(random, -4, 4), whole(random, -4, 4), 0};
        turn.shift = {whole(random, -20, 0), whole(random, -2, 2), 0};
        c.motion_b = EnclosedMotion::turning(
            Pose::from_translation({whole(random, 10, 16), whole(random, -4, 4), 1}), turn);
        return c;
    }
    std::vector<KeyFrame> frames;
    const bool turns = random.chance(2, 3);
    for (int i = 0; i < 2; ++i) {
        KeyFrame f;
        f.time = i;
        if (turns)
            f.rotation = {whole(random, 1, 3), whole(random, -2, 2), whole(random, -2, 2),
                          whole(random, -2, 2)};
        f.position = {i == 0 ? whole(random, 12, 20) : whole(random, -20, 4), whole(random, -8, 8),
                      whole(random, -5, 5)};
        frames.push_back(f);
    }
    c.motion_b = EnclosedMotion::through(frames);
    return c;
}

TEST(EnclosedCertificates, OfRandomScenesAreAccepted) {
    std::array<int, 3> outcomes{};
    int complete = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Case c = random_case(seed);
        const EnclosedCertificate certificate = c.certificate();
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        EXPECT_TRUE(certificate.is_complete) << "seed " << seed;
        complete += certificate.is_complete ? 1 : 0;
        ++outcomes[static_cast<std::size_t>(certificate.answer.outcome)];
    }
    EXPECT_GT(outcomes[0], 30);
    EXPECT_GT(outcomes[1], 50);
    EXPECT_EQ(complete, 200);
    RecordProperty("undecided", outcomes[2]);
}

// Takes the proof away; false where there is nothing to change.
bool corrupt(EnclosedCertificate& c, reference::Random& random) {
    using Kind = EnclosedFreedomNode::Kind;
    if (c.free.empty()) return false;
    trisect::FreeSpan& span = c.free[random.below(c.free.size())];
    auto& tree = random.chance(1, 4) ? span.start : span.freedom;
    EnclosedFreedomNode& n = tree[random.below(tree.size())];
    switch (random.below(10)) {
        case 0:
            if (n.kind == Kind::Separated) return false;
            n.other = 0;
            return true;
        case 1:
            if (n.kind != Kind::Separated) return false;
            for (ExactRational& x : n.plane.normal) x = -x;
            n.plane.offset = -n.plane.offset;
            return true;
        case 2:
            if (n.kind != Kind::SplitTime) return false;
            n.time += 2;
            return true;
        case 3:
            tree.pop_back();
            return true;
        case 4:
            c.free.pop_back();
            return true;
        case 5:
            // Free for longer than its tree.
            span.span.to += 1;
            return true;
        case 6:
            c.triangles_a.pop_back();
            return true;
        case 7:
            if (!c.in_both) return false;
            (*c.in_both)[0] += ExactRational(100);
            return true;
        case 8:
            if (c.in_both)
                c.in_both.reset();
            else
                c.answer.contact_by = 1;
            return true;
        default:
            c.answer.free_until = 1.5;
            return c.free.size() == 1;
    }
}

TEST(EnclosedCertificates, CorruptedAreRejected) {
    reference::Random random(7);
    int corrupted = 0;
    for (std::uint64_t seed = 400; corrupted < 1000; ++seed) {
        const Case c = random_case(seed);
        const EnclosedCertificate right = c.certificate();
        if (!right.is_complete) continue;
        for (int k = 0; k < 20; ++k) {
            EnclosedCertificate wrong = right;
            if (!corrupt(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << k;
            ++corrupted;
        }
    }
}

}  // namespace
}  // namespace enclosed_certificate_test
