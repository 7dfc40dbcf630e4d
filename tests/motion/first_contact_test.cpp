// SPDX-License-Identifier: Apache-2.0
//
// First contact of small solids against brute force in rationals, and named configurations.

#include <trisect/bsp/first_contact.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "motion_oracle.h"
#include "reference/random_solids.h"

namespace {

using oracle::Placement;
using reference::Operand;
using reference::Rational;
using trisect::AlgebraicNumber;
using trisect::ContactWitness;
using trisect::ExactRational;
using trisect::first_contact;
using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;
using trisect::UsageError;

ExactRational q(const std::string& text) { return ExactRational::from_string(text); }

InterferenceModel box(double x0, double y0, double z0, double x1, double y1, double z1) {
    return InterferenceModel(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
}

Motion falling(double by) { return Motion::translation(Pose(), {0, 0, -by}); }

void expect_at(const FirstContact& c, const char* s) {
    ASSERT_TRUE(c.exists());
    EXPECT_EQ(*c.time, AlgebraicNumber(q(s))) << c.time->to_double();
}

// vertex-vertex, vertex-edge, ..., from the side of A.
std::multiset<std::string> kinds(const FirstContact& c) {
    const auto name = [](const trisect::BoundaryFeature& f) {
        return f.vertex.is_valid() ? "vertex" : f.edge.is_valid() ? "edge" : "face";
    };
    std::multiset<std::string> r;
    for (const ContactWitness& w : c.witnesses) r.insert(std::string(name(w.a)) + "-" + name(w.b));
    return r;
}

// Named configurations ---------------------------------------------------------------------------

TEST(FirstContact, BlockFallsFlatOntoALargerOne) {
    const FirstContact c =
        first_contact(box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), falling(4));
    expect_at(c, "1/2");
    EXPECT_EQ(kinds(c), (std::multiset<std::string>{"face-vertex", "face-vertex", "face-vertex",
                                                    "face-vertex"}));
}

TEST(FirstContact, BlockFallsAcrossAnotherOne) {
    // Flat on flat, no vertex over a face: edges cross.
    const FirstContact c =
        first_contact(box(0, 1, 0, 4, 2, 1), Motion(), box(1, 0, 3, 2, 4, 4), falling(4));
    expect_at(c, "1/2");
    EXPECT_EQ(kinds(c),
              (std::multiset<std::string>{"edge-edge", "edge-edge", "edge-edge", "edge-edge"}));
}

TEST(FirstContact, EqualBlocksMeetCornerToCorner) {
    const FirstContact c =
        first_contact(box(0, 0, 0, 1, 1, 1), Motion(), box(0, 0, 3, 1, 1, 4), falling(4));
    expect_at(c, "1/2");
    EXPECT_EQ(kinds(c), (std::multiset<std::string>{"vertex-vertex", "vertex-vertex",
                                                    "vertex-vertex", "vertex-vertex"}));
}

TEST(FirstContact, ExactlyAtTheEndCountsAndJustBeforeItDoesNot) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    const auto block = box(1, 1, 3, 2, 2, 4);
    expect_at(first_contact(floor, Motion(), block, falling(2)), "1");
    EXPECT_FALSE(first_contact(floor, Motion(), block, falling(2 - 0x1p-50)).exists());
}

TEST(FirstContact, SlidesPastWithAGapOfOneUnitInTheLastPlace) {
    const double gap = 0x1p-40;
    const auto wall = box(0, 0, 0, 1, 4, 4);
    const auto block = box(1 + gap, 6, 1, 2, 7, 2);
    const Motion along = Motion::translation(Pose(), {0, -12, 0});
    EXPECT_FALSE(first_contact(wall, Motion(), block, along).exists());
    // With no gap the sides touch when the front of one reaches the back of the other.
    expect_at(first_contact(wall, Motion(), box(1, 6, 1, 2, 7, 2), along), "1/6");
}

TEST(FirstContact, TwoEventsAtTheSameTime) {
    // Two feet of different height over steps that make up for it.
    const InterferenceModel stairs(Solid::from_mesh(trisect::make_extrusion(
        std::vector<trisect::Point2d>{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 1}, {0, 1}}, {}, 0, 1)));
    const InterferenceModel feet(Solid::from_mesh(trisect::make_extrusion(
        std::vector<trisect::Point2d>{
            {0.5, 4}, {1, 4}, {1, 5.5}, {2.5, 5.5}, {2.5, 5}, {3, 5}, {3, 6}, {0.5, 6}},
        {}, 0.25, 0.75)));
    const FirstContact c =
        first_contact(stairs, Motion(), feet, Motion::translation(Pose(), {0, -6, 0}));
    expect_at(c, "1/2");
    std::set<trisect::FaceId> faces;
    for (const ContactWitness& w : c.witnesses) faces.insert(w.a.near_face);
    EXPECT_GE(faces.size(), 2U);
}

TEST(FirstContact, BarRotatesIntoAPost) {
    // A bar from the origin to (4, 0), turning by a quarter about z; a post at (0, 3).
    const auto bar = box(0, -0.5, 0, 4, 0.5, 1);
    const auto post = box(-0.5, 2.5, 0, 0.5, 3.5, 1);
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    const FirstContact c = first_contact(post, Motion(), bar, Motion::screw(Pose(), screw));
    ASSERT_TRUE(c.exists());
    // The bar's upper side passes through (0.5, 2.5) at the angle whose tangent t = 2 s / (1 - s^2)
    // solves 2.5 - 0.5 t = 0.5 sqrt(1 + t^2).
    const double s = c.time->to_double();
    const double t = 2 * s / (1 - s * s);
    EXPECT_NEAR(2.5 - 0.5 * t, 0.5 * std::sqrt(1 + t * t), 1e-12);
}

TEST(FirstContact, RotatingBlockGrazesACorner) {
    // The corner (3, 4) of the block turns about the origin and passes (0, 5) at its highest; the
    // block above begins at height 5, or a little higher.
    const auto block = box(0, 0, 0, 3, 4, 1);
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    const Motion turning = Motion::screw(Pose(), screw);
    const auto exactly = box(-1, 5, 0, 1, 6, 1);
    const FirstContact c = first_contact(exactly, Motion(), block, turning);
    expect_at(c, "1/3");  // tan of half of the angle from (3, 4) to (0, 5)
    EXPECT_FALSE(
        first_contact(box(-1, 5 + 0x1p-40, 0, 1, 6, 1), Motion(), block, turning).exists());
    EXPECT_TRUE(first_contact(box(-1, 5 - 0x1p-40, 0, 1, 6, 1), Motion(), block, turning).exists());
}

TEST(FirstContact, InContactAtTheStart) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    expect_at(first_contact(floor, Motion(), box(1, 1, 1, 2, 2, 2), falling(-3)), "0");
    expect_at(first_contact(floor, Motion(), box(1, 1, 1, 2, 2, 2),
                            Motion::translation(Pose(), {9, 0, 0})),
              "0");
}

TEST(FirstContact, BothMoveAndOnlyTheDifferenceCounts) {
    const auto a = box(0, 0, 0, 1, 1, 1);
    const auto b = box(3, 0, 0, 4, 1, 1);
    expect_at(first_contact(a, Motion::translation(Pose(), {4, 7, 1}), b,
                            Motion::translation(Pose(), {0, 7, 1})),
              "1/2");
    // The same screw for both: nothing changes between them.
    Screw screw;
    screw.turn = {3, 1, 1, 2};
    screw.shift = {1, 2, 3};
    const Motion m = Motion::screw(Pose(), screw);
    EXPECT_FALSE(first_contact(a, m, b, m).exists());
}

TEST(FirstContact, TwoArmsTurnTowardsEachOther) {
    const auto arm = box(0, 0, 0, 4, 1, 1);
    Screw left;
    left.turn = {1, 0, 0, 1};
    Screw right = left;
    right.turn = {1, 0, 0, -1};
    right.center = {6, 0, 0};
    // Both lie along the x axis at first and overlap; begin them a quarter turn earlier.
    Screw down = left;
    down.turn = {1, 0, 0, -1};
    const Pose start_left = Motion::screw(Pose(), down).pose_at(1);
    Screw down_right = right;
    down_right.turn = {1, 0, 0, 1};
    const Pose start_right =
        Motion::screw(Pose::from_doubles({-1, 0, 0, 6, 0, 1, 0, 0, 0, 0, -1, 1}), down_right)
            .pose_at(1);
    const FirstContact c =
        first_contact(arm, Motion::screw(start_left, left), arm, Motion::screw(start_right, right));
    ASSERT_TRUE(c.exists());
    // By symmetry they meet in the plane x = 3.
    const double s = c.time->to_double();
    const double angle = 2 * std::atan(s) - std::atan(1.0) * 2;
    const double tip = std::max(4 * std::cos(angle) - std::sin(angle), 4 * std::cos(angle));
    EXPECT_NEAR(tip, 3, 1e-12);
}

TEST(FirstContact, ChainsReportThePieceInTheirParameter) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    const auto block = box(1, 1, 3, 2, 2, 4);
    const std::vector<Pose> poses{Pose(), Pose::from_translation({0, 0, 1}),
                                  Pose::from_translation({0, 0, -3}),
                                  Pose::from_translation({0, 0, -9})};
    expect_at(first_contact(floor, Motion(), block, Motion::through(poses)), "7/4");
    expect_at(first_contact(block, Motion::through(poses), floor, Motion()), "7/4");
    const std::vector<Pose> two{Pose(), Pose::from_translation({1, 0, 0}), Pose()};
    EXPECT_THROW((void)first_contact(floor, Motion::through(two), block, Motion::through(poses)),
                 UsageError);
}

TEST(FirstContact, EmptySolidsMeetNothing) {
    EXPECT_FALSE(
        first_contact(InterferenceModel(), Motion(), box(0, 0, 0, 1, 1, 1), falling(3)).exists());
}

TEST(FirstContact, MirroredSolid) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    const Pose mirror = Pose::from_doubles({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0});
    expect_at(first_contact(floor, Motion(), box(1, 1, -4, 2, 2, -3),
                            Motion::translation(mirror, {0, 0, -4})),
              "1/2");
}

// Random solids on a small grid -------------------------------------------------------------------

std::string text(const Rational& r) { return r.get_str(); }

struct Scene {
    Operand a;
    Operand b;
    Placement pa;
    Placement pb;
};

std::int64_t small(reference::Random& random) { return random.between(-2, 2); }

Placement random_placement(reference::Random& random, bool turning) {
    Placement p;
    if (random.chance(1, 2))
        p.quaternion = {random.between(1, 3), small(random), small(random), small(random)};
    if (turning) p.screw.turn = {random.between(3, 9), small(random), small(random), small(random)};
    for (std::size_t i = 0; i < 3; ++i) {
        p.screw.center[i] = static_cast<double>(random.between(0, 8));
        p.screw.shift[i] = static_cast<double>(random.between(-4, 4));
    }
    return p;
}

Scene random_scene(reference::Random& random, bool turning, bool both) {
    Scene s;
    s.a = reference::random_embedded_solid(random);
    s.b = reference::random_embedded_solid(random);
    if (both) s.pa = random_placement(random, turning);
    s.pb = random_placement(random, turning);
    // Away from each other, then together.
    const std::size_t axis = random.below(3);
    const double side = random.chance(1, 2) ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) s.pb.at[i] = static_cast<double>(random.between(-5, 5));
    s.pb.at[axis] = side * static_cast<double>(random.between(14, 22));
    s.pb.screw.shift[axis] -= side * static_cast<double>(random.between(10, 30));
    return s;
}

// No contact of boundaries at the rational times before the first one, contact at that time when it
// is rational, and for irrational times none at the lower end of a narrow bracket.
void compare_with_brute_force(const Scene& scene, std::size_t& contacts, std::size_t& rational,
                              std::size_t& none) {
    if (oracle::boundaries_meet(scene.a, scene.pa, scene.b, scene.pb, 0)) return;
    const InterferenceModel a(engines::solid(scene.a));
    const InterferenceModel b(engines::solid(scene.b));
    const FirstContact c = first_contact(a, scene.pa.motion(), b, scene.pb.motion());
    const auto meet = [&scene](const Rational& s) {
        return oracle::boundaries_meet(scene.a, scene.pa, scene.b, scene.pb, s);
    };
    for (int d = 1; d <= 6; ++d)
        for (int n = 1; n <= d; ++n) {
            Rational s(n, d);
            s.canonicalize();
            const AlgebraicNumber t(q(text(s)));
            if (c.exists() && t > *c.time) continue;
            EXPECT_EQ(meet(s), c.exists() && t == *c.time) << "at " << s;
        }
    if (!c.exists()) {
        ++none;
        return;
    }
    ++contacts;
    EXPECT_FALSE(c.witnesses.empty());
    const AlgebraicNumber narrow = c.time->refined(q("1/1000000000000"));
    if (narrow.is_rational()) {
        ++rational;
        EXPECT_TRUE(meet(Rational(narrow.lower().to_string()))) << narrow.lower().to_string();
    } else {
        EXPECT_FALSE(meet(Rational(narrow.lower().to_string()))) << narrow.lower().to_string();
    }
}

void run(std::uint64_t seed, int rounds, bool turning, bool both) {
    reference::Random random(seed);
    std::size_t contacts = 0;
    std::size_t rational = 0;
    std::size_t none = 0;
    for (int i = 0; i < rounds && !::testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " round " + std::to_string(i));
        compare_with_brute_force(random_scene(random, turning, both), contacts, rational, none);
    }
    EXPECT_GT(contacts, static_cast<std::size_t>(rounds) / 8);
    EXPECT_GT(none, 0U);
    ::testing::Test::RecordProperty("contacts", static_cast<int>(contacts));
    ::testing::Test::RecordProperty("none", static_cast<int>(none));
    if (!turning) {
        EXPECT_GT(rational, 0U);
    }
}

TEST(RandomSolids, Translations) { run(1, 300, false, false); }
TEST(RandomSolids, Screws) { run(2, 300, true, false); }
TEST(RandomSolids, TwoTranslations) { run(3, 200, false, true); }
TEST(RandomSolids, TwoScrews) { run(4, 200, true, true); }

}  // namespace
