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
void all_sign_patterns(const Plane::Coefficient& n, const Plane::Coefficient& d) {
    const auto plane = [&](unsigned signs) {
        return Plane((signs & 1U) != 0 ? -n : n, (signs & 2U) != 0 ? -n : n,
                     (signs & 4U) != 0 ? -n : n, (signs & 8U) != 0 ? -d : d);
    };
    for (unsigned k = 0; k < 4096; ++k)
        expect_exact(plane(k & 15U), plane(k >> 4 & 15U), plane(k >> 8 & 15U), plane(0));
    expect_exact(plane(10), plane(12), plane(6), plane(0));  // Hadamard
}

// The largest coefficients of every tier, and the smallest of the next one (plane.cpp).
struct TierLimit {
    int tier;
    int normal_bits;
    int offset_bits;
};
constexpr std::array<TierLimit, 5> tier_limits{TierLimit{0, 56, 83}, TierLimit{1, 112, 168},
                                               TierLimit{2, 174, 230}, TierLimit{3, 230, 286},
                                               TierLimit{4, 328, 383}};

Plane::Coefficient largest(int bits) {
    if (bits == 383)  // 2^383 is negative
        return Plane::Coefficient(1).shifted_left(382) - Plane::Coefficient(1) +
               Plane::Coefficient(1).shifted_left(382);
    return Plane::Coefficient(1).shifted_left(bits) - Plane::Coefficient(1);
}

TEST(Bounds, LargestCoefficientsOfAllTiers) {
    for (const TierLimit& t : tier_limits) {
        SCOPED_TRACE(t.tier);
        const Plane::Coefficient n = largest(t.normal_bits);
        const Plane::Coefficient d = largest(t.offset_bits);
        ASSERT_EQ(Plane(n, n, n, d).tier(), t.tier);
        ASSERT_EQ(Plane(n, n, n, d).is_narrow(), t.tier == 0);
        all_sign_patterns(n, d);
        if (t.tier == 4) continue;
        const Plane::Coefficient beyond = Plane::Coefficient(1).shifted_left(t.normal_bits);
        EXPECT_EQ(Plane(beyond, n, n, d).tier(), t.tier + 1);
        EXPECT_EQ(Plane(n, n, n, Plane::Coefficient(1).shifted_left(t.offset_bits)).tier(),
                  t.tier + 1);
    }
}

TEST(Bounds, TiersMixed) {
    for (const TierLimit& t : tier_limits)
        for (const TierLimit& u : tier_limits) {
            const Plane::Coefficient n = largest(t.normal_bits);
            const Plane::Coefficient d = largest(t.offset_bits);
            const Plane::Coefficient m = largest(u.normal_bits);
            const Plane::Coefficient e = largest(u.offset_bits);
            expect_exact(Plane(n, n, -n, d), Plane(m, -m, m, -e), Plane(-n, n, n, d),
                         Plane(m, m, m, e));
            expect_exact(Plane(n, n, n, d), Plane(m, m, -m, e), Plane(n, -n, n, d),
                         Plane(m, m, m, -e));
        }
}

TEST(Bounds, NarrowAndWideMixed) {
    const auto n = (trisect::Int128{1} << 109) - 1;
    const auto d = Plane::Coefficient(1).shifted_left(163) - Plane::Coefficient(1);
    const Plane x = Plane::axis_aligned(0, 1, 1);
    const Plane y = Plane::axis_aligned(1, 1, 1);
    const Plane wide(n, -n, n, d);
    expect_exact(x, y, wide, Plane(n, n, n, d));
    expect_exact(x, y, wide, Plane::axis_aligned(2, 1, 5));
    expect_exact(x, y, Plane::axis_aligned(2, 1, 5), wide);
}

// One unit beside the exact coincidence, where the largest numbers cancel completely.
TEST(Bounds, LargestNumbersThatCancel) {
    const Plane::Coefficient one(1);
    for (const TierLimit& t : tier_limits) {
        const Plane::Coefficient n = largest(t.normal_bits);
        const Plane::Coefficient d = largest(t.offset_bits);
        for (const auto& off : {Plane::Coefficient(0), one, one + one}) {
            expect_exact(Plane(n, n, n, d), Plane(n, -n, n, d), Plane(n, n, -n, d),
                         Plane(-n, n, n, d - off));
            expect_exact(Plane(n, n, n, d), Plane(n, n - one, n, d - off), Plane(n - one, n, n, d),
                         Plane(n, n, n - one, d - one));
        }
    }
}

// Coordinates with bits behind the point: each from none to all that are allowed.
TEST(Bounds, FractionalCoordinates) {
    oracle::Source random(20261123);
    std::array<int, 5> planes_of_tier{};
    for (int round = 0; round < 4000; ++round) {
        const int before = static_cast<int>(random.between(1, 53));
        const int behind = static_cast<int>(random.between(0, trisect::fraction_limit));
        const auto plane = [&] {
            const Plane p = random.plane(before, behind);
            ++planes_of_tier[static_cast<std::size_t>(p.tier())];
            return p;
        };
        expect_exact(plane(), plane(), plane(), plane());
    }
    for (const int n : planes_of_tier) EXPECT_GT(n, 50);
}

// The finest lattice's largest coordinates: the bounds of plane.h.
TEST(Bounds, FinestCoordinates) {
    oracle::Source random(7);
    const auto coordinate = [&] {
        // The largest coordinate with all its bits, and the finest one.
        const double v = random.coin() ? 0x1p53 - 1 : 0x1p-20 - 0x1p-73;
        return trisect::Coordinate(random.coin() ? v : -v);
    };
    const auto corner = [&] {
        return trisect::LatticePoint{coordinate(), coordinate(), coordinate()};
    };
    for (int round = 0; round < 2000; ++round) {
        const auto plane = [&] {
            for (;;) {
                const auto a = corner();
                const auto b = corner();
                const auto c = corner();
                if (!are_collinear(a, b, c)) return Plane::through(a, b, c);
            }
        };
        expect_exact(plane(), plane(), plane(), plane());
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
