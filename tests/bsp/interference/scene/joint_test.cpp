// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/interference/joint.h>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "exact_pose.h"

namespace joint_test {
namespace {

using scene_test::exact;
using scene_test::ExactPose;
using trisect::Joint;
using trisect::LimitError;
using trisect::Pose;
using trisect::Ratio;
using trisect::UsageError;

constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();

TEST(Joint, FixedHasOnlyTheValueZero) {
    const Joint joint = Joint::fixed();
    EXPECT_EQ(joint.kind(), Joint::Kind::Fixed);
    EXPECT_EQ(joint.motion({}), Pose());
    EXPECT_EQ(joint.motion({0, 7}), Pose());
    EXPECT_THROW((void)joint.motion({1, 7}), UsageError);
}

TEST(Joint, QuarterAndHalfTurnsAboutALine) {
    const Joint joint = Joint::revolute({1, 2, 3}, {0, 0, 1});
    // x goes to y about (1, 2): (x, y) -> (1 - (y - 2), 2 + (x - 1)).
    EXPECT_EQ(joint.motion({1, 1}), Pose::from_doubles({0, -1, 0, 3, 1, 0, 0, 1, 0, 0, 1, 0}));
    EXPECT_EQ(joint.motion({1, 0}), Pose::from_doubles({-1, 0, 0, 2, 0, -1, 0, 4, 0, 0, 1, 0}));
    EXPECT_EQ(joint.motion({-1, 0}), joint.motion({1, 0}));
    EXPECT_EQ(joint.motion({0, -5}), Pose());
}

TEST(Joint, ThirdOfATurnAboutADiagonal) {
    // tan(60 degrees) / sqrt(3) = 1.
    const Joint joint = Joint::revolute({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(joint.motion({1, 1}), Pose::from_doubles({0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
}

TEST(Joint, TurnsAndTheirOppositesCancel) {
    const Joint joint = Joint::revolute({0.1, 0.2, 0.3}, {3, -4, 12});
    EXPECT_EQ(joint.motion({355, 113}) * joint.motion({-355, 113}), Pose());
    EXPECT_EQ(joint.motion({1, 3}) * joint.motion({1, 3}), joint.motion({3, -80}))
        << "tan(a) of |axis| = 13 and r = 1/3: 2 r / (1 - 169 r r) = -3/80";
}

TEST(Joint, TurnAsRodriguesInFractions) {
    const std::array<double, 3> point{0.1, -7.25, 1e-3};
    const std::array<std::int64_t, 3> axis{2, -3, 5};
    const Joint joint = Joint::revolute(point, axis);
    for (const Ratio r : {Ratio{1, 2}, Ratio{-22, 7}, Ratio{123456, -98765}}) {
        EXPECT_EQ(exact(joint.motion(r)), ExactPose::turn(point, axis, r.numerator, r.denominator));
    }
}

TEST(Joint, SlidesByFractionsOfADirection) {
    const Joint joint = Joint::prismatic({0.1, 0, -4});
    ExactPose expected;
    const auto tenth = trisect::ExactRational::from_double(0.1);
    expected.rows[0][3] = tenth * 2 / 3;
    expected.rows[2][3] = trisect::ExactRational(-8) / 3;
    EXPECT_EQ(exact(joint.motion({2, 3})), expected);
    EXPECT_EQ(joint.motion({0, 3}), Pose());
    EXPECT_THROW((void)joint.motion({1, 0}), UsageError);
}

TEST(Joint, ValueOfAQuaternion) {
    const Joint joint = Joint::revolute({0, 0, 0}, {0, 2, 4});
    const Ratio r = joint.value_of({7, 0, 3, 6});
    EXPECT_EQ(joint.motion(r), Pose::from_quaternion({7, 0, 3, 6}));
    EXPECT_EQ(joint.motion(joint.value_of({0, 0, -1, -2})), Pose::from_quaternion({0, 0, 1, 2}));
    EXPECT_EQ(joint.motion(joint.value_of({-3, 0, 0, 0})), Pose());
    EXPECT_THROW((void)joint.value_of({7, 1, 3, 6}), UsageError);
    EXPECT_THROW((void)joint.value_of({0, 0, 0, 0}), UsageError);
    EXPECT_THROW((void)Joint::prismatic({1, 0, 0}).value_of({1, 1, 0, 0}), UsageError);
}

TEST(Joint, ValueNearAnAngle) {
    const Joint unit = Joint::revolute({0, 0, 0}, {0, 0, 1});
    const Joint skew = Joint::revolute({0, 0, 0}, {30, -40, 120});
    EXPECT_EQ(unit.motion(unit.value_near(90)), unit.motion({1, 1}));
    EXPECT_EQ(unit.motion(unit.value_near(180)), unit.motion({1, 0}));
    EXPECT_EQ(unit.motion(unit.value_near(-270)), unit.motion({1, 1}));
    EXPECT_EQ(unit.motion(unit.value_near(720)), Pose());
    for (const double degrees : {0.001, 1.0, 30.0, 89.0, 179.9, -135.0}) {
        for (const int bits : {10, 20, 30}) {
            for (const Joint& joint : {unit, skew}) {
                const auto m = joint.motion(joint.value_near(degrees, bits)).approximate();
                const double trace = m[0] + m[5] + m[10];
                // 1 + 2 cos(angle)
                EXPECT_NEAR(trace, 1 + 2 * std::cos(degrees * std::acos(-1) / 180),
                            std::ldexp(8, -bits) + 1e-12)
                    << degrees << " " << bits;
            }
        }
    }
    EXPECT_THROW((void)unit.value_near(std::nan("")), UsageError);
    EXPECT_THROW((void)unit.value_near(1, 31), UsageError);
}

TEST(Joint, NonsenseIsRefused) {
    EXPECT_THROW((void)Joint::revolute({0, 0, 0}, {0, 0, 0}), UsageError);
    EXPECT_THROW((void)Joint::revolute({0, std::nan(""), 0}, {0, 0, 1}), UsageError);
    EXPECT_THROW((void)Joint::revolute({0, 0, 0}, {0, 0, largest}), LimitError);
    EXPECT_THROW((void)Joint::prismatic({0, HUGE_VAL, 0}), UsageError);
    const Joint joint = Joint::revolute({0, 0, 0}, {0, 0, 1});
    EXPECT_THROW((void)joint.motion({0, 0}), UsageError);
    EXPECT_THROW((void)joint.motion({largest, 1}), LimitError);
    EXPECT_THROW((void)joint.motion({1, largest}), LimitError);
    EXPECT_EQ(joint.motion({largest, largest}), joint.motion({1, 1}));
}

}  // namespace
}  // namespace joint_test
