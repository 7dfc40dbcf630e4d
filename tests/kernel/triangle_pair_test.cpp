// SPDX-License-Identifier: Apache-2.0
//
// Pairs of triangles in general position against exact arithmetic: two triangles meet iff an edge
// of one goes through the other.

#include <trisect/kernel/triangle_pair.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"
#include "support/triangle_oracle.h"

namespace {

using trisect::LatticePoint;
using trisect::detail::relate_triangles;
using trisect::detail::SidedTriangle;
using trisect::detail::TrianglePair;

using Triangle = std::array<LatticePoint, 3>;

int sign(std::int64_t x) { return x < 0 ? -1 : (x > 0 ? 1 : 0); }

// Side of d with respect to the plane through a, b, c: 1 above.
int side(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
         const LatticePoint& d) {
    const auto minus = [](const LatticePoint& p, const LatticePoint& q) {
        return std::array<std::int64_t, 3>{p.x - q.x, p.y - q.y, p.z - q.z};
    };
    const auto u = minus(b, a);
    const auto v = minus(c, a);
    const auto w = minus(d, a);
    return sign((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                (u[0] * v[1] - u[1] * v[0]) * w[2]);
}

// 1: the segment goes through the interior, 0: not at all, -1: through an edge or a corner.
int pierces(const LatticePoint& s, const LatticePoint& e, const Triangle& t) {
    if (side(t[0], t[1], t[2], s) == side(t[0], t[1], t[2], e)) return 0;
    std::array<int, 3> o{};
    for (std::size_t k = 0; k < 3; ++k) o[k] = side(s, e, t[k], t[(k + 1) % 3]);
    if (o[0] * o[1] < 0 || o[1] * o[2] < 0 || o[0] * o[2] < 0) return 0;
    return o[0] == 0 || o[1] == 0 || o[2] == 0 ? -1 : 1;
}

SidedTriangle sided(const Triangle& t, const Triangle& other) {
    SidedTriangle s{t, {}};
    for (std::size_t k = 0; k < 3; ++k) s.sides[k] = side(other[0], other[1], other[2], t[k]);
    return s;
}

bool straddles(const SidedTriangle& t) {
    const auto [lo, hi] = std::minmax({t.sides[0], t.sides[1], t.sides[2]});
    const bool zero = t.sides[0] * t.sides[1] * t.sides[2] == 0;
    return lo < 0 && hi > 0 && !zero;
}

void compare(std::int64_t range, int count) {
    std::mt19937_64 random(static_cast<std::uint64_t>(range));
    std::uniform_int_distribution<std::int64_t> at(-range, range);
    const auto triangle = [&] {
        Triangle t;
        for (LatticePoint& p : t) p = {at(random), at(random), at(random)};
        return t;
    };
    int crossing = 0;
    int disjoint = 0;
    for (int i = 0; i < count; ++i) {
        const Triangle a = triangle();
        const Triangle b = triangle();
        const SidedTriangle sa = sided(a, b);
        const SidedTriangle sb = sided(b, a);
        if (!straddles(sa) || !straddles(sb)) continue;
        bool met = false;
        bool touching = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const int ab = pierces(a[k], a[(k + 1) % 3], b);
            const int ba = pierces(b[k], b[(k + 1) % 3], a);
            met = met || ab > 0 || ba > 0;
            touching = touching || ab < 0 || ba < 0;
        }
        const TrianglePair found = relate_triangles(sa, sb);
        if (found == TrianglePair::Unknown) {
            EXPECT_TRUE(touching || range > 1000);
            continue;
        }
        EXPECT_EQ(found == TrianglePair::Crossing, met || touching);
        ++(found == TrianglePair::Crossing ? crossing : disjoint);
    }
    EXPECT_GT(crossing, count / 100);
    EXPECT_GT(disjoint, count / 100);
}

TEST(TrianglePair, AgreesOnASmallGridWhereEdgesMeet) { compare(4, 40000); }
TEST(TrianglePair, AgreesOnALargerGrid) { compare(100, 40000); }
TEST(TrianglePair, AgreesWithCornersOfTwentyBits) { compare(1 << 19, 40000); }

// Coordinates with up to 60 bits behind the point, whose differences are rounded. Half of the pairs
// have a side next to one of the other triangle.
TEST(TrianglePair, AgreesOnCornersWithFractions) {
    oracle::Source random(5);
    int crossing = 0;
    int disjoint = 0;
    for (int i = 0; i < 4000; ++i) {
        Triangle a;
        Triangle b;
        for (auto* t : {&a, &b})
            for (LatticePoint& p : *t) p = random.point(3, 60);
        if (random.coin())
            for (std::size_t k = 0; k < 2; ++k) {
                const auto near = [&](trisect::Coordinate c) {
                    const double by = std::ldexp(1.0, -static_cast<int>(random.between(20, 53)));
                    return trisect::Coordinate(c.to_double() + (random.coin() ? by : -by));
                };
                b[k] = {near(a[k].x), near(a[k].y), near(a[k].z)};
            }
        if (are_collinear(a[0], a[1], a[2]) || are_collinear(b[0], b[1], b[2])) continue;
        const trisect::Plane pa = trisect::Plane::through(a[0], a[1], a[2]);
        const trisect::Plane pb = trisect::Plane::through(b[0], b[1], b[2]);
        SidedTriangle sa{a, {}};
        SidedTriangle sb{b, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            sa.sides[k] = oracle::side(oracle::rational(a[k]), pb);
            sb.sides[k] = oracle::side(oracle::rational(b[k]), pa);
        }
        if (!straddles(sa) || !straddles(sb)) continue;
        const TrianglePair found = relate_triangles(sa, sb);
        if (found == TrianglePair::Unknown) continue;
        const auto exact = [](const Triangle& t) {
            return brute::Triangle3{brute::exact(t[0].doubles()), brute::exact(t[1].doubles()),
                                    brute::exact(t[2].doubles())};
        };
        EXPECT_EQ(found == TrianglePair::Crossing, brute::meet(exact(a), exact(b)));
        ++(found == TrianglePair::Crossing ? crossing : disjoint);
    }
    EXPECT_GT(crossing, 50);
    EXPECT_GT(disjoint, 50);
}

}  // namespace
