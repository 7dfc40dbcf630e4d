// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/plane.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/predicates.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace plane_test {
namespace {

using oracle::numbers;
using trisect::are_collinear;
using trisect::Int128;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Side;
using trisect::side_of;

constexpr std::int64_t far = trisect::coordinate_limit - 1;

void expect_doubles(const Plane& p) {
    const auto n = numbers(p);
    const mpz_class unit = mpz_class(1) << static_cast<mp_bitcnt_t>(p.approx_shift());
    for (int i = 0; i < 3; ++i) {
        const mpz_class& c = n.n[static_cast<std::size_t>(i)];
        const mpq_class off = abs(mpq_class(p.approx_normal(i)) * unit - c);
        EXPECT_LE(mpq_class(off * 0x1p53), abs(c));  // nearest
    }
    const mpq_class off = abs(mpq_class(p.approx_offset()) * unit - n.d);
    EXPECT_LE(mpq_class(off * 0x1p52), abs(n.d));
}

TEST(Plane, ThroughThreePoints) {
    const Plane p = Plane::through({0, 0, 5}, {1, 0, 5}, {0, 1, 5});
    EXPECT_EQ(side_of(LatticePoint{3, 4, 5}, p), Side::On);
    EXPECT_EQ(side_of(LatticePoint{3, 4, 6}, p), Side::Above);
    EXPECT_EQ(side_of(LatticePoint{3, 4, 4}, p), Side::Below);
    EXPECT_TRUE(p.is_narrow());
    EXPECT_TRUE(p.is_valid());
    EXPECT_FALSE(Plane{}.is_valid());
}

TEST(Plane, ThroughAgreesWithGmp) {
    oracle::Source random(1);
    for (int round = 0; round < 5000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const LatticePoint a = random.point(bits);
        const LatticePoint b = random.point(bits);
        const LatticePoint c = random.point(bits);
        const auto x = [](const LatticePoint& p, int i) {
            return oracle::integer(p[i].to_integer());
        };
        bool collinear = true;
        std::array<mpz_class, 3> n;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int l = (i + 2) % 3;
            n[static_cast<std::size_t>(i)] = (x(b, j) - x(a, j)) * (x(c, l) - x(a, l)) -
                                             (x(b, l) - x(a, l)) * (x(c, j) - x(a, j));
            collinear = collinear && n[static_cast<std::size_t>(i)] == 0;
        }
        EXPECT_EQ(are_collinear(a, b, c), collinear);
        if (collinear) {
            EXPECT_THROW((void)Plane::through(a, b, c), trisect::Error);
            continue;
        }
        const Plane p = Plane::through(a, b, c);
        EXPECT_EQ(numbers(p).n, n);
        EXPECT_EQ(numbers(p).d, -(n[0] * x(a, 0) + n[1] * x(a, 1) + n[2] * x(a, 2)));
        expect_doubles(p);
        EXPECT_EQ(Plane::through(b, c, a), p);
        EXPECT_EQ(Plane::through(b, a, c), p.flipped());
        EXPECT_EQ(p.flipped().flipped(), p);
        expect_doubles(p.flipped());
    }
}

TEST(Plane, AlongAxis) {
    oracle::Source random(2);
    for (int round = 0; round < 3000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const LatticePoint a = random.point(bits);
        const LatticePoint b = random.point(bits);
        const int axis = static_cast<int>(random.below(3));
        const int j = (axis + 1) % 3;
        const int k = (axis + 2) % 3;
        if (a[j] == b[j] && a[k] == b[k]) {
            EXPECT_THROW((void)Plane::along_axis(a, b, axis), trisect::Error);
            continue;
        }
        const Plane p = Plane::along_axis(a, b, axis);
        EXPECT_EQ(p.normal(axis), 0);
        EXPECT_EQ(side_of(a, p), Side::On);
        EXPECT_EQ(side_of(b, p), Side::On);
        // Parallel to the axis: a shifted along it stays on the plane.
        LatticePoint shifted = a;
        (axis == 0 ? shifted.x : (axis == 1 ? shifted.y : shifted.z)) = far;
        EXPECT_EQ(side_of(shifted, p), Side::On);
        // Above is where (b - a) × e points to.
        const Plane q = Plane::through(
            a, b, a + LatticePoint{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0});
        EXPECT_TRUE(is_same_plane(p, q));
        EXPECT_TRUE(same_orientation(p, q));
        expect_doubles(p);
    }
}

// Bits behind the point, from none to all.
TEST(Plane, ThroughFractionsAgreesWithGmp) {
    oracle::Source random(20261123);
    int collinear = 0;
    for (int round = 0; round < 5000; ++round) {
        const int before = static_cast<int>(random.between(1, 53));
        const int behind = static_cast<int>(random.between(0, trisect::fraction_limit));
        const LatticePoint a = random.point(before, behind);
        const LatticePoint b = random.point(before, behind);
        // Sometimes on the line: the middle, where it is a double.
        const bool middle = random.below(4) == 0;
        const auto mean = [](trisect::Coordinate p, trisect::Coordinate q) {
            return trisect::Coordinate(p.to_double() * 0.5 + q.to_double() * 0.5);
        };
        const LatticePoint c = middle ? LatticePoint{mean(a.x, b.x), mean(a.y, b.y), mean(a.z, b.z)}
                                      : random.point(before, behind);
        if (trisect::detail::fraction_bits(c) > trisect::fraction_limit) continue;
        const auto p = oracle::rational(a);
        const auto q = oracle::rational(b);
        const auto r = oracle::rational(c);
        std::array<mpq_class, 3> n;
        mpq_class d = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t l = (i + 2) % 3;
            n[i] = (q[j] - p[j]) * (r[l] - p[l]) - (q[l] - p[l]) * (r[j] - p[j]);
            d -= n[i] * p[i];
        }
        const bool on_line = n[0] == 0 && n[1] == 0 && n[2] == 0;
        ASSERT_EQ(are_collinear(a, b, c), on_line);
        collinear += on_line ? 1 : 0;
        if (on_line) {
            EXPECT_THROW((void)Plane::through(a, b, c), trisect::Error);
            continue;
        }
        const Plane plane = Plane::through(a, b, c);
        const int bits =
            std::max({trisect::detail::fraction_bits(a), trisect::detail::fraction_bits(b),
                      trisect::detail::fraction_bits(c)});
        const mpz_class unit = mpz_class(1) << static_cast<mp_bitcnt_t>(3 * bits);
        for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(numbers(plane).n[i], n[i] * unit);
        ASSERT_EQ(numbers(plane).d, d * unit);
        expect_doubles(plane);
        for (const LatticePoint& x : {a, b, c}) ASSERT_EQ(side_of(x, plane), Side::On);
        const LatticePoint x = random.point(before, behind);
        ASSERT_EQ(side_of(x, plane), static_cast<Side>(oracle::side(oracle::rational(x), plane)));
        ASSERT_EQ(plane.flipped().flipped(), plane);
        ASSERT_EQ(plane.flipped(), Plane::through(b, a, c));
        // The same plane from other corners, with more bits behind the point.
        const auto direction = plane.direction();
        mpz_class common = 0;
        for (std::size_t i = 0; i < 3; ++i) common = gcd(common, numbers(plane).n[i]);
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_EQ(oracle::integer(direction[i]) * common, numbers(plane).n[i]);
    }
    EXPECT_GT(collinear, 20);
}

TEST(Plane, AlongAxisThroughFractions) {
    oracle::Source random(5);
    for (int round = 0; round < 3000; ++round) {
        const int behind = static_cast<int>(random.between(0, trisect::fraction_limit));
        const LatticePoint a = random.point(53, behind);
        const LatticePoint b = random.point(53, behind);
        const int axis = static_cast<int>(random.below(3));
        if (a[(axis + 1) % 3] == b[(axis + 1) % 3] && a[(axis + 2) % 3] == b[(axis + 2) % 3])
            continue;
        const Plane p = Plane::along_axis(a, b, axis);
        ASSERT_EQ(p.normal(axis), 0);
        ASSERT_EQ(side_of(a, p), Side::On);
        ASSERT_EQ(side_of(b, p), Side::On);
        // Above is where (b - a) × e points to.
        LatticePoint shifted = a;
        trisect::Coordinate& c = axis == 0 ? shifted.x : (axis == 1 ? shifted.y : shifted.z);
        c = c.to_double() < 0 ? 1 : -1;
        const Plane q = c.to_double() > a[axis].to_double() ? Plane::through(a, b, shifted)
                                                            : Plane::through(b, a, shifted);
        ASSERT_TRUE(is_same_plane(p, q));
        ASSERT_TRUE(same_orientation(p, q));
        expect_doubles(p);
    }
}

TEST(Plane, AxisAligned) {
    for (int axis = 0; axis < 3; ++axis) {
        const Plane p = Plane::axis_aligned(axis, 2, 7);  // between 3 and 4
        LatticePoint low{0, 0, 0};
        LatticePoint high{0, 0, 0};
        (axis == 0 ? low.x : (axis == 1 ? low.y : low.z)) = 3;
        (axis == 0 ? high.x : (axis == 1 ? high.y : high.z)) = 4;
        EXPECT_EQ(side_of(low, p), Side::Below);
        EXPECT_EQ(side_of(high, p), Side::Above);
        EXPECT_EQ(p.dominant_axis(), axis);
        EXPECT_EQ(numbers(p).d, -7);
    }
}

TEST(Plane, DominantAxisPrefersTheFirst) {
    EXPECT_EQ(Plane(1, 1, 1, Plane::Coefficient(0)).dominant_axis(), 0);
    EXPECT_EQ(Plane(1, -2, 2, Plane::Coefficient(0)).dominant_axis(), 1);
    EXPECT_EQ(Plane(1, -2, -3, Plane::Coefficient(0)).dominant_axis(), 2);
}

TEST(Plane, NarrowAtItsLimits) {
    const Int128 n = Int128{1} << 56;
    const Plane::Coefficient d = Plane::Coefficient(1).shifted_left(83);
    const Plane::Coefficient one(1);
    EXPECT_TRUE(Plane(n - 1, 0, 0, one).is_narrow());
    EXPECT_TRUE(Plane(0, 1 - n, 0, one).is_narrow());
    EXPECT_FALSE(Plane(0, 0, n, one).is_narrow());
    EXPECT_FALSE(Plane(-n, 0, 0, one).is_narrow());
    EXPECT_TRUE(Plane(1, 0, 0, d - one).is_narrow());
    EXPECT_TRUE(Plane(1, 0, 0, one - d).is_narrow());
    EXPECT_FALSE(Plane(1, 0, 0, d).is_narrow());
    EXPECT_FALSE(Plane(1, 0, 0, -d).is_narrow());
}

TEST(Plane, LatticesOf26BitsAreNarrow) {
    // The largest coefficients come from corners of the cube.
    constexpr std::int64_t v = (std::int64_t{1} << 26) - 1;
    for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
            for (int c = 0; c < 8; ++c) {
                const auto corner = [](int k) {
                    return LatticePoint{(k & 1) != 0 ? v : -v, (k & 2) != 0 ? v : -v,
                                        (k & 4) != 0 ? v : -v};
                };
                if (are_collinear(corner(a), corner(b), corner(c))) continue;
                EXPECT_TRUE(Plane::through(corner(a), corner(b), corner(c)).is_narrow());
            }
}

TEST(Plane, RefusesCoefficientsBeyondTheWidestTier) {
    const Plane::Coefficient one(1);
    EXPECT_THROW(Plane(one.shifted_left(330), one, one, one), trisect::LimitError);
}

}  // namespace
}  // namespace plane_test
