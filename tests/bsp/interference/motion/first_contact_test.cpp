// SPDX-License-Identifier: Apache-2.0
//
// First contact of small solids against brute force in rationals, and named configurations.

#include <trisect/bsp/interference/first_contact.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/models.h"
#include "support/motion_oracle.h"
#include "support/moving_pair.h"
#include "support/numbers.h"

namespace {

using models::box;
using moving::by;
using moving::small;
using numbers::q;
using oracle::Placement;
using reference::Operand;
using reference::Rational;
using trisect::AlgebraicNumber;
using trisect::ContactEvent;
using trisect::ContactWitness;
using trisect::Diagnostics;
using trisect::ExactRational;
using trisect::first_contact;
using trisect::FirstContact;
using trisect::FirstContactCounters;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::Pose;
using trisect::Relation;
using trisect::Screw;
using trisect::Solid;
using trisect::UsageError;

Motion falling(double by) { return Motion::translation(Pose(), {0, 0, -by}); }

trisect::FirstContactOptions facing_only() {
    trisect::FirstContactOptions options;
    options.leave_out_receding = true;
    return options;
}

void expect_at(const FirstContact& c, const char* s) {
    ASSERT_TRUE(c.exists());
    EXPECT_EQ(*c.time, AlgebraicNumber(q(s))) << c.time->to_double();
}

// vertex-vertex, vertex-edge, ..., from the side of A.
std::multiset<std::string> kinds(const FirstContact& c) {
    const auto name = [](const trisect::BoundaryEntity& e) {
        return e.is_vertex() ? "vertex" : e.is_edge() ? "edge" : "face";
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
    // Four corners below each foot; at the lower step two of them are over its edge.
    EXPECT_EQ(c.witnesses.size(), 8U);
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

// Fine meshes: parts that move away from each other are left out, and nothing else changes.
TEST(FirstContact, PartsThatMoveApartAreLeftOut) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 48, 24)));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(0.5, 3)));
    const Motion still;
    std::vector<Motion> motions;
    for (const double x : {0.0, 0.25, 0.6875, 1.0, 1.3125, 1.75, 1.9375})
        motions.emplace_back(
            Motion::translation(Pose::from_translation({x, 0.125, 3}), {0.125, 0, -6}));
    for (const double x : {1.0, 1.5, 2.0}) {
        Screw screw;
        screw.turn = {3, 0, 1, 1};
        screw.shift = {0, 0, -6};
        motions.emplace_back(Motion::screw(Pose::from_translation({x, 0.125, 3}), screw));
    }
    std::uint64_t left_out = 0;
    std::uint64_t pairs = 0;
    std::uint64_t all_pairs = 0;
    for (const Motion& motion : motions)
        for (const InterferenceModel* b : {&ball, &torus}) {
            const Diagnostics<FirstContactCounters> of_facing;
            const FirstContact c = first_contact(torus, still, *b, motion, facing_only());
            left_out += of_facing.counters().separating_pairs;
            pairs += of_facing.counters().triangle_pairs;
            const Diagnostics<FirstContactCounters> of_whole;
            const FirstContact whole = first_contact(torus, still, *b, motion);
            all_pairs += of_whole.counters().triangle_pairs;
            ASSERT_EQ(c.exists(), whole.exists());
            EXPECT_EQ(c.time, whole.time);
            EXPECT_EQ(c.witnesses, whole.witnesses);
            // And the other one moving.
            const FirstContact back = first_contact(*b, motion, torus, still, facing_only());
            EXPECT_EQ(back.time, whole.time);
            EXPECT_EQ(back.witnesses.size(), whole.witnesses.size());
        }
    EXPECT_GT(left_out, 100U);
    EXPECT_LE(pairs, all_pairs);
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

// Overlap: what may go on after a contact
// ------------------------------------------------------------

FirstContact first_overlap(const InterferenceModel& a, const Motion& ma, const InterferenceModel& b,
                           const Motion& mb) {
    return first_contact(a, ma, b, mb, {ContactEvent::Overlap});
}

TEST(FirstOverlap, BlockThatFallsOntoAFloor) {
    expect_at(first_overlap(box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), falling(4)),
              "1/2");
    // It only just arrives.
    EXPECT_FALSE(
        first_overlap(box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), falling(2)).exists());
}

TEST(FirstOverlap, BlockThatLiesOnAFloor) {
    const auto floor = box(0, 0, 0, 8, 8, 1);
    const auto block = box(1, 1, 1, 2, 2, 2);
    const FirstContact down = first_overlap(floor, Motion(), block, by(0, 0, -1));
    expect_at(down, "0");
    EXPECT_EQ(down.at_start, Relation::Touching);
    EXPECT_FALSE(down.witnesses.empty());
    EXPECT_FALSE(first_overlap(floor, Motion(), block, by(0, 0, 1)).exists());   // lifts
    EXPECT_FALSE(first_overlap(floor, Motion(), block, by(3, 2, 0)).exists());   // slides
    EXPECT_FALSE(first_overlap(floor, Motion(), block, by(30, 2, 0)).exists());  // and off it
    EXPECT_FALSE(first_overlap(floor, Motion(), block, by(0, 0, 0)).exists());
}

TEST(FirstOverlap, BlockSlidesOnAFloorAgainstAWallOfItsOwnHeight) {
    // Floor and wall are one solid; the block is exactly as wide and as high as the wall: every
    // edge that comes in is in a plane with one that is there.
    const InterferenceModel room(Solid::from_mesh(trisect::make_extrusion(
        std::vector<trisect::Point2d>{{0, 0}, {8, 0}, {8, 2}, {6, 2}, {6, 1}, {0, 1}}, {}, 0, 2)));
    const auto block = box(1, 1, 0, 2, 2, 2);
    const FirstContact c = first_overlap(room, Motion(), block, by(8, 0, 0));
    expect_at(c, "1/2");
    EXPECT_FALSE(c.witnesses.empty());
    EXPECT_FALSE(first_overlap(room, Motion(), block, by(4, 0, 0)).exists());
    // Up along the wall and over it.
    EXPECT_FALSE(first_overlap(room, by(0, 0, 0), box(5, 1, 0, 6, 2, 2), by(0, 5, 0)).exists());
}

TEST(FirstOverlap, BlockSlidesAlongAComb) {
    // Over the tops of thirty teeth, against a wall behind them. Each tooth makes four events.
    std::vector<trisect::Point2d> outline{{0, 0}, {64, 0}, {64, 3}, {62, 3}, {62, 1}};
    for (int i = 30; i > 0; --i)
        for (const auto& [x, y] : {std::pair{2 * i + 1, 1}, {2 * i + 1, 2}, {2 * i, 2}, {2 * i, 1}})
            outline.push_back({static_cast<double>(x), static_cast<double>(y)});
    outline.push_back({0, 1});
    const InterferenceModel comb(Solid::from_mesh(trisect::make_extrusion(outline, {}, 0, 2)));
    const auto block = box(2, 2, 0.5, 5, 3, 1.5);
    const Diagnostics<FirstContactCounters> diagnostics;
    const FirstContact c = first_overlap(comb, Motion(), block, by(114, 0, 0));
    expect_at(c, "1/2");
    EXPECT_EQ(c.at_start, Relation::Touching);
    // Some searches, not one for every event.
    EXPECT_GT(diagnostics.counters().intervals, 0U);
    EXPECT_LT(diagnostics.counters().intervals, 400U);
    EXPECT_FALSE(first_overlap(comb, Motion(), block, by(57, 0, 0)).exists());
}

TEST(FirstOverlap, LiesOnTheFloorLiftsAndFallsBack) {
    const auto floor = box(0, 0, 0, 8, 8, 1);
    const auto block = box(1, 1, 1, 2, 2, 2);
    const Pose up = Pose::from_translation({1, 0, 3});
    const std::vector<Pose> back{Pose(), up, Pose::from_translation({2, 0, 0})};
    EXPECT_FALSE(first_overlap(floor, Motion(), block, Motion::through(back)).exists());
    const std::vector<Pose> too_far{Pose(), up, Pose::from_translation({2, 0, -3})};
    expect_at(first_overlap(floor, Motion(), block, Motion::through(too_far)), "3/2");
    const std::vector<Pose> turned_down{Pose(), Pose::from_translation({1, 0, 0}),
                                        Pose::from_translation({1, 0, -1})};
    const FirstContact c = first_overlap(floor, Motion(), block, Motion::through(turned_down));
    expect_at(c, "1");
    EXPECT_FALSE(c.witnesses.empty());
}

TEST(FirstOverlap, GrazingCornerGoesOn) {
    const auto block = box(0, 0, 0, 3, 4, 1);
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    const Motion turning = Motion::screw(Pose(), screw);
    EXPECT_FALSE(first_overlap(box(-1, 5, 0, 1, 6, 1), Motion(), block, turning).exists());
    EXPECT_TRUE(first_overlap(box(-1, 5 - 0x1p-40, 0, 1, 6, 1), Motion(), block, turning).exists());
}

TEST(FirstOverlap, PinTurnsInAHoleThatItsCornersGraze) {
    // A pin of 6 by 8 with its corners on a circle turns in a square hole around that circle, its
    // corners grazing the walls; not in a smaller one.
    const auto frame = [](double half) {
        const std::vector<std::vector<trisect::Point2d>> hole{
            {{-half, -half}, {-half, half}, {half, half}, {half, -half}}};
        return InterferenceModel(Solid::from_mesh(trisect::make_extrusion(
            std::vector<trisect::Point2d>{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, hole, 0, 1)));
    };
    // Corners on the circle of radius 5.
    const InterferenceModel pin(Solid::from_mesh(trisect::make_extrusion(
        std::vector<trisect::Point2d>{{-3, -4}, {3, -4}, {3, 4}, {-3, 4}}, {}, 0, 1)));
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    const Motion quarter = Motion::screw(Pose(), screw);
    EXPECT_FALSE(first_overlap(frame(5), Motion(), pin, quarter).exists());
    expect_at(first_contact(frame(5), Motion(), pin, quarter), "1/3");
    EXPECT_TRUE(first_overlap(frame(4.5), Motion(), pin, quarter).exists());
    expect_at(first_overlap(frame(4), Motion(), pin, quarter), "0");
}

TEST(FirstOverlap, InteriorsThatMeetAtTheStart) {
    const auto outer = box(0, 0, 0, 4, 4, 4);
    for (const ContactEvent event : {ContactEvent::Touch, ContactEvent::Overlap}) {
        const FirstContact inside =
            first_contact(outer, Motion(), box(1, 1, 1, 2, 2, 2), by(9, 0, 0), {event});
        expect_at(inside, "0");
        EXPECT_EQ(inside.at_start, Relation::Contains);
        EXPECT_TRUE(inside.witnesses.empty());
        const FirstContact crossing =
            first_contact(outer, Motion(), box(3, 1, 1, 5, 2, 2), by(9, 0, 0), {event});
        expect_at(crossing, "0");
        EXPECT_EQ(crossing.at_start, Relation::Overlapping);
        EXPECT_FALSE(crossing.witnesses.empty());
    }
}

TEST(FirstOverlap, SmallSolidInACavityMovesToItsWall) {
    using trisect::Expression;
    const Solid shell =
        trisect::evaluate(Expression(Solid::from_mesh(trisect::make_box({0, 0, 0}, {9, 9, 9}))) -
                          Expression(Solid::from_mesh(trisect::make_box({1, 1, 1}, {8, 8, 8}))));
    const auto small = box(3, 3, 3, 4, 4, 4);
    expect_at(first_contact(InterferenceModel(shell), Motion(), small, by(8, 0, 0)), "1/2");
    expect_at(first_overlap(InterferenceModel(shell), Motion(), small, by(8, 0, 0)), "1/2");
    EXPECT_FALSE(first_contact(InterferenceModel(shell), Motion(), small, by(3, 1, 2)).exists());
}

// Random solids on a small grid -------------------------------------------------------------------

std::string text(const Rational& r) { return r.get_str(); }

struct Scene {
    Operand a;
    Operand b;
    Placement pa;
    Placement pb;
};

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
    const Diagnostics<FirstContactCounters> diagnostics;
    const FirstContact whole = first_contact(a, scene.pa.motion(), b, scene.pb.motion());
    EXPECT_EQ(diagnostics.counters().separating_pairs, 0U);
    // What moves apart plays no part in it.
    const FirstContact c = first_contact(a, scene.pa.motion(), b, scene.pb.motion(), facing_only());
    ASSERT_EQ(c.exists(), whole.exists());
    EXPECT_EQ(c.time, whole.time);
    EXPECT_EQ(c.witnesses, whole.witnesses);
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

// Until the overlap no static query finds that interiors meet, right after it one does; without one
// none does anywhere.
void compare_with_static_queries(const Scene& scene, std::size_t& overlaps, std::size_t& passed) {
    const InterferenceModel a(engines::solid(scene.a));
    const InterferenceModel b(engines::solid(scene.b));
    const Motion ma = scene.pa.motion();
    const Motion mb = scene.pb.motion();
    const auto overlap_at = [&](const ExactRational& s) {
        const Relation r = trisect::interfere(a, ma.pose_at(s), b, mb.pose_at(s)).relation;
        return r != Relation::Disjoint && r != Relation::Touching;
    };
    if (overlap_at(0)) return;
    const FirstContact touch = first_contact(a, ma, b, mb, facing_only());
    const FirstContact c = first_overlap(a, ma, b, mb);
    for (int d = 1; d <= 6; ++d)
        for (int n = 1; n <= d; ++n) {
            const ExactRational s = ExactRational(n) / ExactRational(d);
            if (!c.exists() || AlgebraicNumber(s) <= *c.time) {
                EXPECT_FALSE(overlap_at(s)) << s.to_string();
            }
        }
    if (!c.exists()) {
        passed += touch.exists() ? 1U : 0U;
        return;
    }
    ++overlaps;
    ASSERT_TRUE(touch.exists());
    EXPECT_LE(*touch.time, *c.time);
    EXPECT_TRUE(overlap_at(c.time->refined(q("1/1073741824")).upper() + q("1/1073741824")));
}

TEST(RandomSolids, OverlapsAgreeWithStaticQueries) {
    reference::Random random(5);
    std::size_t overlaps = 0;
    std::size_t passed = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE("round " + std::to_string(i));
        Scene scene = random_scene(random, i % 4 == 0, i % 8 == 0);
        // Half of them slide along a coordinate axis, where faces are flush more often.
        if (i % 2 == 1) scene.pb.quaternion = {1, 0, 0, 0};
        compare_with_static_queries(scene, overlaps, passed);
    }
    EXPECT_GT(overlaps, 40U);
    EXPECT_GT(passed, 0U);
}

}  // namespace
