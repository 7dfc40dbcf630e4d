// SPDX-License-Identifier: Apache-2.0
//
// The widths of the registers at the largest values that the bounds in plane.h and predicates.cpp
// admit: whatever is too narrow gives a wrong number here.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

#include "support/gmp_oracle.h"

namespace {

using trisect::Approximation;
using trisect::HomogeneousPoint;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Side;

const Approximation vague{{0, 0, 0}, 1e300};

std::array<mpz_class, 3> homogeneous_determinants(const Plane& p, const Plane& q, const Plane& r) {
    const auto a = oracle::numbers(p);
    const auto b = oracle::numbers(q);
    const auto c = oracle::numbers(r);
    std::array<mpz_class, 3> out;
    for (std::size_t i = 0; i < 3; ++i) {
        auto u = a.n;
        auto v = b.n;
        auto t = c.n;
        u[i] = -a.d;
        v[i] = -b.d;
        t[i] = -c.d;
        out[i] = oracle::det3(u, v, t);
    }
    return out;
}

// Every number that belongs to the point and its side of s, by GMP.
void expect_exact(const Plane& p, const Plane& q, const Plane& r, const Plane& s) {
    const mpz_class w =
        oracle::det3(oracle::numbers(p).n, oracle::numbers(q).n, oracle::numbers(r).n);
    EXPECT_EQ(sign_of_det(p, q, r), sgn(w));
    const auto h = intersect(p, q, r);
    ASSERT_EQ(h.has_value(), w != 0);
    if (!h) return;
    const auto x = homogeneous_determinants(p, q, r);
    ASSERT_EQ(oracle::integer(h->w), abs(w));
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class expected = w < 0 ? mpz_class(-x[i]) : x[i];
        ASSERT_EQ(oracle::integer(h->xyz[i]), expected);
    }
    const auto side = static_cast<Side>(oracle::side(oracle::rational(*h), s));
    EXPECT_EQ(side_of(*h, s), side);
    EXPECT_EQ(side_of(vague, p, q, r, s), side);
    EXPECT_EQ(side_of(approximate(p, q, r), p, q, r, s), side);
    const auto d = nearest_doubles(*h);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(d[i], oracle::nearest(oracle::rational(*h)[i]));
    EXPECT_EQ(nearest_doubles(approximate(p, q, r), p, q, r), d);
}

// Planes whose coefficients all have the largest magnitude, with every pattern of signs; among them
// are the Hadamard matrices, whose determinants reach the bound 16 N^3 D.
void all_sign_patterns(const trisect::Int128& n, const Plane::Offset& d) {
    const auto plane = [&](unsigned signs) {
        return Plane((signs & 1U) != 0 ? -n : n, (signs & 2U) != 0 ? -n : n,
                     (signs & 4U) != 0 ? -n : n, (signs & 8U) != 0 ? -d : d);
    };
    for (unsigned k = 0; k < 4096; ++k)
        expect_exact(plane(k & 15U), plane(k >> 4 & 15U), plane(k >> 8 & 15U), plane(0));
    expect_exact(plane(10), plane(12), plane(6), plane(0));  // Hadamard
}

TEST(Bounds, LargestNarrowCoefficients) {
    const auto n = (trisect::Int128{1} << 56) - 1;
    const auto d = Plane::Offset(1).shifted_left(83) - Plane::Offset(1);
    ASSERT_TRUE(Plane(n, n, n, d).is_narrow());
    all_sign_patterns(n, d);
}

TEST(Bounds, LargestCoefficients) {
    const auto n = (trisect::Int128{1} << 109) - 1;
    const auto d = Plane::Offset(1).shifted_left(163) - Plane::Offset(1);
    ASSERT_FALSE(Plane(n, n, n, d).is_narrow());
    all_sign_patterns(n, d);
}

TEST(Bounds, NarrowAndWideMixed) {
    const auto n = (trisect::Int128{1} << 109) - 1;
    const auto d = Plane::Offset(1).shifted_left(163) - Plane::Offset(1);
    const Plane x = Plane::axis_aligned(0, 1, 1);
    const Plane y = Plane::axis_aligned(1, 1, 1);
    const Plane wide(n, -n, n, d);
    expect_exact(x, y, wide, Plane(n, n, n, d));
    expect_exact(x, y, wide, Plane::axis_aligned(2, 1, 5));
    expect_exact(x, y, Plane::axis_aligned(2, 1, 5), wide);
}

// One unit beside the exact coincidence, where the largest numbers cancel completely.
TEST(Bounds, LargestNumbersThatCancel) {
    const auto n = (trisect::Int128{1} << 109) - 1;
    const auto d = Plane::Offset(1).shifted_left(163) - Plane::Offset(1);
    const Plane::Offset one(1);
    for (const auto& off : {Plane::Offset(0), one, one + one}) {
        expect_exact(Plane(n, n, n, d), Plane(n, -n, n, d), Plane(n, n, -n, d),
                     Plane(-n, n, n, d - off));
        expect_exact(Plane(n, n, n, d), Plane(n, n - 1, n, d - off), Plane(n - 1, n, n, d),
                     Plane(n, n, n - 1, d - one));
    }
}

// Planes through the corners of the largest cube, and of cubes one or two units smaller.
TEST(Bounds, ExtremeCoordinates) {
    oracle::Source random(1);
    const std::int64_t far = trisect::coordinate_limit - 1;
    const auto corner = [&] {
        const auto c = [&] {
            const std::int64_t m = far - static_cast<std::int64_t>(random.below(3));
            return random.coin() ? m : -m;
        };
        return LatticePoint{c(), c(), c()};
    };
    const auto plane = [&] {
        for (;;) {
            const LatticePoint a = corner();
            const LatticePoint b = corner();
            const LatticePoint c = corner();
            if (are_collinear(a, b, c)) continue;
            const Plane p = Plane::through(a, b, c);
            EXPECT_EQ(side_of(a, p), Side::On);
            EXPECT_EQ(side_of(b, p), Side::On);
            EXPECT_EQ(side_of(c, p), Side::On);
            const LatticePoint x = corner();
            EXPECT_EQ(static_cast<int>(side_of(x, p)), oracle::side(oracle::rational(x), p));
            EXPECT_LE(p.offset().bit_length(), 163);
            return p;
        }
    };
    for (int round = 0; round < 5000; ++round) {
        const Plane p = plane();
        const Plane q = plane();
        const Plane r = plane();
        const Plane s = plane();
        expect_exact(p, q, r, s);
        const auto a = intersect(p, q, r);
        const auto b = intersect(p, q, s);
        if (!a || !b) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const int expected = sgn(oracle::rational(*a)[i] - oracle::rational(*b)[i]);
            const auto order = compare_coordinate(*a, *b, axis);
            EXPECT_EQ(order < 0 ? -1 : (order > 0 ? 1 : 0), expected);
        }
    }
}

}  // namespace
