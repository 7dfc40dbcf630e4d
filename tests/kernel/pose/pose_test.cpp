// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/pose.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/pose/relative_pose.h>

#include "support/gmp_oracle.h"
#include "support/pose_oracle.h"

namespace {

using oracle::map_of;
using oracle::pose_kinds;
using oracle::PoseKind;
using oracle::random_pose;
using trisect::Lattice;
using trisect::LimitError;
using trisect::Pose;
using trisect::UsageError;
using trisect::detail::BoundedInt;
using trisect::detail::PosedPair;
using trisect::detail::relative_pose;
using trisect::detail::RelativePose;

// ---------------------------------------------------------------- integers on the stack

BoundedInt random_int(oracle::Source& random) {
    BoundedInt v(random.coordinate(static_cast<int>(1 + random.below(62))));
    for (auto n = random.below(8); n > 0; --n) {
        v = v.shifted_left(static_cast<int>(random.below(130)));
        if (random.coin()) v += BoundedInt(random.coordinate(60));
    }
    return v;
}

TEST(BoundedIntegers, ComputeAsGmpDoes) {
    oracle::Source random(1);
    for (int round = 0; round < 20000; ++round) {
        const BoundedInt a = random_int(random);
        const BoundedInt b = random_int(random);
        const mpz_class x = oracle::integer(a);
        const mpz_class y = oracle::integer(b);
        EXPECT_EQ(oracle::integer(a + b), x + y);
        EXPECT_EQ(oracle::integer(a - b), x - y);
        EXPECT_EQ(oracle::integer(a * b), x * y);
        EXPECT_EQ(oracle::integer(-a), -x);
        EXPECT_EQ(a.sign(), sgn(x));
        EXPECT_EQ(a == b, x == y);
        EXPECT_TRUE((a - a).is_zero());
        EXPECT_EQ(oracle::integer(gcd(a, b)), gcd(x, y));
        if (!b.is_zero()) {
            EXPECT_EQ(divided_exactly(a * b, b), a);
        }
        const BoundedInt::Scaled s = a.scaled();
        const mpq_class back = mpq_class(s.mantissa) * oracle::power_of_two(s.exponent);
        EXPECT_LE(abs(back - x), abs(mpq_class(x)) * oracle::power_of_two(-52));
        EXPECT_EQ(static_cast<std::size_t>(a.bit_length()),
                  x == 0 ? 0 : mpz_sizeinbase(x.get_mpz_t(), 2));
    }
}

TEST(BoundedIntegers, BeyondTheCapacityIsAnError) {
    const BoundedInt big = BoundedInt(1).shifted_left(4100);
    EXPECT_THROW((void)(big * big), trisect::Error);
    EXPECT_THROW((void)big.shifted_left(4200), trisect::Error);
    EXPECT_NO_THROW((void)(big * big.shifted_right(100)));
}

// ---------------------------------------------------------------- poses

TEST(Poses, AreTheMapOfTheTwelveDoubles) {
    oracle::Source random(2);
    for (int round = 0; round < 2000; ++round) {
        std::array<double, 12> rows{};
        for (double& v : rows)
            v = random.below(5) == 0 ? 0
                                     : std::ldexp(oracle::real(random, 1),
                                                  static_cast<int>(random.below(200)) - 100);
        try {
            const auto map = map_of(Pose::from_doubles(rows));
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j)
                    EXPECT_EQ(map.m[i][j], mpq_class(rows[4 * i + j]));
                EXPECT_EQ(map.t[i], mpq_class(rows[4 * i + 3]));
            }
        } catch (const UsageError&) {
            EXPECT_EQ(rows[0] * (rows[5] * rows[10] - rows[6] * rows[9]) -
                          rows[1] * (rows[4] * rows[10] - rows[6] * rows[8]) +
                          rows[2] * (rows[4] * rows[9] - rows[5] * rows[8]),
                      0);
        }
    }
}

TEST(Poses, OfQuaternionsAreRotations) {
    oracle::Source random(3);
    for (int round = 0; round < 500; ++round) {
        const Pose p = random_pose(
            random, random.coin() ? PoseKind::Quaternion : PoseKind::WideQuaternion, 100);
        const auto m = map_of(p);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const mpq_class dot =
                    m.m[i][0] * m.m[j][0] + m.m[i][1] * m.m[j][1] + m.m[i][2] * m.m[j][2];
                EXPECT_EQ(dot, i == j ? 1 : 0);
            }
        EXPECT_EQ(oracle::determinant(m), 1);
        EXPECT_FALSE(p.is_mirror());
        // The inverse is the transpose, with numbers no larger than the rotation's.
        const Pose back = p.inverse();
        EXPECT_EQ(back.denominator().bit_length() <= 110, true);
    }
    const auto quarter = map_of(Pose::from_quaternion({1, 0, 0, 1}, {5, 6, 7.5}));
    EXPECT_EQ(quarter({1, 0, 0}), (oracle::RationalPoint{5, 7, mpq_class(15, 2)}));
    EXPECT_EQ(Pose::from_quaternion({3, 0, 0, 3}), Pose::from_quaternion({-1, 0, 0, -1}));
}

TEST(Poses, ComposeAndInvertExactly) {
    oracle::Source random(4);
    for (int round = 0; round < 1000; ++round) {
        const auto a = random_pose(random, pose_kinds[random.below(pose_kinds.size())], 50);
        const auto b = random_pose(random, pose_kinds[random.below(pose_kinds.size())], 50);
        EXPECT_EQ(map_of(a * b), oracle::composed(map_of(a), map_of(b)));
        EXPECT_EQ(map_of(a.inverse()), oracle::inverse(map_of(a)));
        EXPECT_EQ(a.inverse() * a, Pose());
        EXPECT_EQ(a * a.inverse(), Pose());
        EXPECT_EQ(a.is_mirror(), oracle::determinant(map_of(a)) < 0);
        EXPECT_EQ((a * b).is_mirror(), a.is_mirror() != b.is_mirror());
        EXPECT_EQ(a == b, map_of(a) == map_of(b));
        const auto approximate = a.approximate();
        for (std::size_t i = 0; i < 12; ++i) {
            const mpq_class exact = i % 4 == 3 ? map_of(a).t[i / 4] : map_of(a).m[i / 4][i % 4];
            EXPECT_LE(abs(exact - approximate[i]), abs(exact) * oracle::power_of_two(-50));
        }
    }
}

TEST(Poses, RefuseWhatIsNoPose) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)Pose::from_doubles({1, 0, 0, infinite, 0, 1, 0, 0, 0, 0, 1, 0}), UsageError);
    EXPECT_THROW((void)Pose::from_doubles({std::nan(""), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}),
                 UsageError);
    EXPECT_THROW((void)Pose::from_doubles({1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}), UsageError);
    EXPECT_THROW((void)Pose::from_doubles({}), UsageError);
    EXPECT_THROW((void)Pose::from_quaternion({0, 0, 0, 0}), UsageError);
    EXPECT_THROW((void)Pose::from_quaternion({1, 0, 0, 0}, {0, infinite, 0}), UsageError);
    EXPECT_THROW((void)Pose::from_quaternion({std::int64_t{1} << 60, 0, 0, 0}), UsageError);
    EXPECT_THROW((void)Pose::from_doubles({1e300, 0, 0, 0, 0, 1e-300, 0, 0, 0, 0, 1, 0}),
                 LimitError);
    EXPECT_THROW((void)Pose::from_translation({1e300, 1e-300, 0}), LimitError);
    EXPECT_NO_THROW((void)Pose::from_translation({1e50, 1e-50, 0}));
    EXPECT_THROW((void)Pose::from_integers(std::array<Pose::Number, 9>{},
                                           std::array<Pose::Number, 3>{}, Pose::Number(1)),
                 UsageError);
}

TEST(Poses, OfIntegersMayHaveANegativeDenominator) {
    const std::array<Pose::Number, 9> m{2, 0, 0, 0, -2, 0, 0, 0, 2};
    const Pose p = Pose::from_integers(m, std::array<Pose::Number, 3>{4, 0, 0}, -2);
    EXPECT_EQ(p, Pose::from_doubles({-1, 0, 0, -2, 0, 1, 0, 0, 0, 0, -1, 0}));
    EXPECT_FALSE(p.is_mirror());
}

// ---------------------------------------------------------------- relative poses

TEST(RelativePoses, GoFromLatticeToLatticeExactly) {
    oracle::Source random(5);
    for (int round = 0; round < 2000; ++round) {
        const auto a = random_pose(random, pose_kinds[random.below(pose_kinds.size())], 50);
        const auto b = random_pose(random, pose_kinds[random.below(pose_kinds.size())], 50);
        const Lattice u{8 * static_cast<int>(random.between(-9, 4))};
        const Lattice v{8 * static_cast<int>(random.between(-9, 4))};
        const PosedPair pair(a, u, b, v);
        const auto expected = oracle::relative(a, u.exponent, b, v.exponent);
        EXPECT_EQ(map_of(pair.to_a), expected);
        EXPECT_EQ(map_of(pair.to_b), oracle::inverse(expected));
        EXPECT_GT(pair.to_a.denominator().sign(), 0);
        EXPECT_EQ(pair.to_a.is_mirror(), a.is_mirror() != b.is_mirror());
        EXPECT_LE(pair.to_a.width(), RelativePose::bits);
        ASSERT_TRUE(pair.to_a.has_doubles());
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                EXPECT_LE(abs(expected.m[i][j] - pair.to_a.approx_rows()[i][j]),
                          abs(expected.m[i][j]) * oracle::power_of_two(-50));
            EXPECT_LE(abs(expected.t[i] - pair.to_a.approx_translation()[i]),
                      abs(expected.t[i]) * oracle::power_of_two(-50));
        }
        const trisect::Point p(random.point(static_cast<int>(1 + random.below(53))));
        const auto moved = pair.to_a.move(p.approximation());
        const auto exact = expected(oracle::rational(p));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LE(abs(exact[i] - moved.c[i]), mpq_class(moved.error));
    }
}

TEST(RelativePoses, OfTheSamePoseAreTheIdentity) {
    oracle::Source random(6);
    for (int round = 0; round < 300; ++round) {
        const auto a = random_pose(random, pose_kinds[random.below(pose_kinds.size())], 50);
        const RelativePose r = relative_pose(a, Lattice{-8}, a, Lattice{-8});
        EXPECT_TRUE(r.is_translation());
        EXPECT_EQ(r.width(), 1);
    }
}

TEST(RelativePoses, OfRotationsKeepTheirNumbersSmall) {
    oracle::Source random(7);
    for (int round = 0; round < 300; ++round) {
        const auto a = random_pose(random, PoseKind::Quaternion, 100);
        const auto b = random_pose(random, PoseKind::Quaternion, 100);
        const PosedPair pair(a, Lattice{}, b, Lattice{});
        EXPECT_LE(pair.to_a.width(), 24);
        EXPECT_LE(pair.to_b.width(), 24);
    }
}

TEST(RelativePoses, SayWhenTheyAreTooWide) {
    const Pose wide = Pose::from_doubles({1, 0x1p-400, 0, 0, 0, 1, 0x1p-300, 0, 0x1p-333, 0, 1, 0});
    EXPECT_THROW((void)relative_pose(wide, Lattice{}, wide * wide.inverse(), Lattice{}),
                 LimitError);
    EXPECT_NO_THROW((void)relative_pose(Pose(), Lattice{}, wide, Lattice{}));
    EXPECT_THROW((void)relative_pose(Pose(), Lattice{1000}, Pose::from_translation({1, 0, 0}),
                                     Lattice{-1000}),
                 LimitError);
}

TEST(RelativePoses, GoFarWithoutDoubles) {
    const RelativePose r =
        relative_pose(Pose(), Lattice{}, Pose::from_translation({0x1p300, 1, 0}), Lattice{});
    EXPECT_FALSE(r.has_doubles());
    EXPECT_EQ(r.translation()[0].bit_length(), 301);
}

}  // namespace
