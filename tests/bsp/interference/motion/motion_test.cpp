// SPDX-License-Identifier: Apache-2.0
//
// Motions: what poses they pass through, and what is refused.

#include <trisect/bsp/interference/motion.h>

#include <gtest/gtest.h>

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/kernel/error.h>

#include "support/numbers.h"

namespace {

using numbers::q;
using trisect::ExactRational;
using trisect::Motion;
using trisect::Pose;
using trisect::Screw;
using trisect::UnsupportedError;
using trisect::UsageError;

TEST(Motion, StandsStillAtAPose) {
    EXPECT_TRUE(Motion().is_still());
    const Pose pose = Pose::from_quaternion({3, 1, 0, 2}, {5, 0, 1});
    const Motion m(pose);
    EXPECT_TRUE(m.is_still());
    EXPECT_EQ(m.pose_at(q("1/3")), pose);
}

TEST(Motion, TranslationIsLinear) {
    const Motion m = Motion::translation(Pose::from_translation({1, 0, 0}), {0, 4, -8});
    EXPECT_FALSE(m.is_still());
    EXPECT_EQ(m.pose_at(0), Pose::from_translation({1, 0, 0}));
    EXPECT_EQ(m.pose_at(q("1/4")), Pose::from_translation({1, 1, -2}));
    EXPECT_EQ(m.pose_at(1), Pose::from_translation({1, 4, -8}));
    EXPECT_TRUE(Motion::translation(Pose(), {}).is_still());
}

TEST(Motion, BlendEndsAtItsPoses) {
    const Pose a = Pose::from_quaternion({1, 0, 0, 0}, {1, 2, 3});
    const Pose b = Pose::from_quaternion({5, 1, 2, 0}, {-1, 2, 0});
    const Motion m = Motion::blend(a, b);
    EXPECT_EQ(m.pose_at(0), a);
    EXPECT_EQ(m.pose_at(1), b);
}

TEST(Motion, BlendThroughAFlatSolidIsRefused) {
    // Half a turn about z: at one half every point is on the axis.
    EXPECT_THROW((void)Motion::blend(Pose(), Pose::from_quaternion({0, 0, 0, 1})),
                 UnsupportedError);
}

TEST(Motion, ScrewTurnsAboutItsAxisAndShifts) {
    Screw screw;
    screw.turn = {1, 0, 0, 1};  // a quarter turn about z
    screw.center = {1, 0, 0};
    screw.shift = {0, 0, 2};
    const Motion m = Motion::screw(Pose(), screw);
    EXPECT_EQ(m.pose_at(0), Pose());
    // (x, y) -> (1 - y, x - 1), up by two.
    EXPECT_EQ(m.pose_at(1), Pose::from_doubles({0, -1, 0, 1, 1, 0, 0, -1, 0, 0, 1, 2}));
    const Pose half = Pose::from_quaternion({2, 0, 0, 1});
    EXPECT_EQ(m.pose_at(q("1/2")),
              Pose::from_translation({1, 0, 1}) * half * Pose::from_translation({-1, 0, 0}));
    const auto approximate = m.approximate_pose_at(0.5);
    EXPECT_NEAR(approximate[0], 0.6, 1e-15);
    EXPECT_NEAR(approximate[11], 1, 1e-15);
}

TEST(Motion, ScrewOfHalfATurnIsRefused) {
    Screw screw;
    screw.turn = {0, 0, 0, 1};
    EXPECT_THROW((void)Motion::screw(Pose(), screw), UsageError);
    screw.turn = {-1, 0, 0, 1};
    EXPECT_THROW((void)Motion::screw(Pose(), screw), UsageError);
}

TEST(Motion, ChainMustHangTogether) {
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    const Motion quarter = Motion::screw(Pose(), screw);
    const Motion next = Motion::screw(quarter.pose_at(1), screw);
    const Motion half = quarter.then(next);
    EXPECT_EQ(half.piece_count(), 2U);
    EXPECT_EQ(half.pose_at(2), Pose::from_quaternion({0, 0, 0, 1}));
    EXPECT_EQ(half.pose_at(1), quarter.pose_at(1));
    EXPECT_THROW((void)quarter.then(quarter), UsageError);
    EXPECT_THROW((void)half.pose_at(q("5/2")), UsageError);
}

TEST(Motion, ManyAreJoinedAtOnce) {
    std::vector<Motion> steps;
    Pose at;
    for (int i = 1; i <= 20; ++i) {
        const Pose next = Pose::from_translation({0, i % 3 * 1.0, -i * 1.0});
        steps.push_back(Motion::blend(at, next));
        at = next;
    }
    const Motion all = Motion::joined(steps);
    ASSERT_EQ(all.piece_count(), steps.size());
    EXPECT_EQ(all.pose_at(20), at);
    EXPECT_EQ(all.pose_at(q("7/2")), steps[3].pose_at(q("1/2")));
    EXPECT_EQ(all.then(Motion(at)).piece_count(), 21U);
    std::swap(steps[3], steps[4]);
    EXPECT_THROW((void)Motion::joined(steps), UsageError);
    EXPECT_THROW((void)Motion::joined({}), UsageError);
}

TEST(Motion, MovedFromStandsStill) {
    static_assert(std::is_nothrow_move_constructible_v<Motion>);
    Motion m = Motion::translation(Pose(), {0, 0, 1});
    const Motion taken = std::move(m);
    EXPECT_TRUE(m.is_still());  // NOLINT(bugprone-use-after-move): that is the test
    EXPECT_EQ(m.piece_count(), 1U);
    EXPECT_EQ(m.pose_at(1), Pose());
    EXPECT_EQ(taken.pose_at(1), Pose::from_translation({0, 0, 1}));

    trisect::EnclosedMotion e(taken);
    const trisect::EnclosedMotion kept = std::move(e);
    EXPECT_TRUE(e.is_still());  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(e.duration(), 1);
    EXPECT_TRUE(e.enclose(0, 1).motion.is_still());
    EXPECT_FALSE(kept.is_still());
}

TEST(Motion, ThroughPoses) {
    const std::vector<Pose> poses{Pose(), Pose::from_translation({1, 0, 0}),
                                  Pose::from_translation({1, 1, 0})};
    const Motion m = Motion::through(poses);
    EXPECT_EQ(m.piece_count(), 2U);
    EXPECT_EQ(m.pose_at(q("3/2")), Pose::from_translation({1, 0.5, 0}));
    EXPECT_THROW((void)Motion::through(std::vector<Pose>{Pose()}), UsageError);
}

TEST(Motion, AnyRationalMotion) {
    // Along a parabola: (s, s^2, 0).
    std::array<std::vector<ExactRational>, 12> entries;
    entries[0] = entries[5] = entries[10] = {1};
    entries[3] = {0, 1};
    entries[7] = {0, 0, 1};
    const Motion m = Motion::rational(entries, {1});
    EXPECT_EQ(m.pose_at(q("1/2")), Pose::from_translation({0.5, 0.25, 0}));
    EXPECT_THROW((void)Motion::rational(entries, {1, -2}), UsageError);
    EXPECT_THROW((void)Motion::rational(entries, {}), UsageError);
    entries[0] = {1, -1};
    EXPECT_THROW((void)Motion::rational(entries, {1}), UnsupportedError);
}

}  // namespace
