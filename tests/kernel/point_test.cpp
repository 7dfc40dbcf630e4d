// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/point.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace point_test {
namespace {

using trisect::HomogeneousPoint;
using trisect::LatticePoint;
using trisect::nearest_double;
using trisect::Plane;
using trisect::Point;
using trisect::WideInt;

constexpr std::int64_t far = trisect::coordinate_limit - 1;

int sign(std::strong_ordering o) { return o < 0 ? -1 : (o > 0 ? 1 : 0); }

// A plane through x with two random corners.
Plane plane_at(const LatticePoint& x, oracle::Source& random, int bits) {
    for (;;) {
        const LatticePoint b = random.point(bits);
        const LatticePoint c = random.point(bits);
        if (!are_collinear(x, b, c)) return Plane::through(x, b, c);
    }
}

TEST(Point, DefaultIsTheOrigin) {
    const Point p;
    EXPECT_TRUE(p.is_lattice());
    EXPECT_EQ(p, Point(LatticePoint{0, 0, 0}));
    EXPECT_EQ(p.plane_point(), nullptr);
}

TEST(Point, IntegerCoordinatesMakeALatticePoint) {
    oracle::Source random(1);
    for (int round = 0; round < 3000; ++round) {
        const int bits = static_cast<int>(2 + random.below(52));
        const LatticePoint x = random.point(bits);
        const Plane p = plane_at(x, random, bits);
        const Plane q = plane_at(x, random, bits);
        const Plane r = plane_at(x, random, bits);
        if (!meet_in_a_point(p, q, r)) continue;
        const Point named(p, q, r);
        ASSERT_TRUE(named.is_lattice());
        EXPECT_EQ(named.lattice(), x);
        EXPECT_EQ(named, Point(x));
        EXPECT_EQ(named.nearest()[0], x.x.to_double());
        EXPECT_EQ(named.approximation().error, 0);
    }
}

TEST(Point, LatticeEndsAtTheCoordinateLimit) {
    const Plane y = Plane::axis_aligned(1, 1, 0);
    const Plane z = Plane::axis_aligned(2, 1, 0);
    EXPECT_TRUE(Point(Plane::axis_aligned(0, 1, far), y, z).is_lattice());
    EXPECT_TRUE(Point(Plane::axis_aligned(0, 1, -far), y, z).is_lattice());
    EXPECT_FALSE(Point(Plane::axis_aligned(0, 1, far + 1), y, z).is_lattice());
    EXPECT_FALSE(Point(Plane::axis_aligned(0, 1, -far - 1), y, z).is_lattice());
    // far + 1/2 rounds to the limit, far - 1/2 lies between two lattice points.
    EXPECT_FALSE(Point(Plane::axis_aligned(0, 2, 2 * far + 1), y, z).is_lattice());
    EXPECT_FALSE(Point(Plane::axis_aligned(0, 2, 2 * far - 1), y, z).is_lattice());
    EXPECT_TRUE(Point(Plane::axis_aligned(0, 2, 2 * far), y, z).is_lattice());
    // A third of a unit beside an integer so large that the nearest double is that integer.
    EXPECT_FALSE(Point(Plane::axis_aligned(0, 3, 3 * (far / 2) + 1), y, z).is_lattice());
}

TEST(Point, PlanesWithoutACommonPointAreRefused) {
    const Plane x = Plane::axis_aligned(0, 1, 0);
    EXPECT_THROW(Point(x, x, Plane::axis_aligned(1, 1, 0)), trisect::Error);
}

// Two points that are equal as numbers are equal as points, and only those.
TEST(Point, EqualityAndOrderAreThoseOfNumbers) {
    oracle::Source random(2);
    for (const int bits : {1, 2, 3, 10, 26, 53}) {
        std::vector<Plane> planes;
        for (int k = 0; k < 9; ++k) planes.push_back(random.plane(bits));
        // A pencil through one line, so that different triples name the same points.
        const LatticePoint a = random.point(bits);
        const LatticePoint b = random.point(bits) + LatticePoint{0, 0, 1};
        for (int k = 0; k < 4; ++k) {
            const LatticePoint c = random.point(bits);
            if (!are_collinear(a, b, c)) planes.push_back(Plane::through(a, b, c));
        }
        std::vector<Point> points;
        std::vector<oracle::RationalPoint> numbers;
        for (std::size_t i = 0; i < planes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k)
                    if (meet_in_a_point(planes[i], planes[j], planes[k])) {
                        points.emplace_back(planes[i], planes[j], planes[k]);
                        numbers.push_back(oracle::rational(planes[i], planes[j], planes[k]));
                    }
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(oracle::rational(points[i]), numbers[i]);
            for (std::size_t j = 0; j < points.size(); ++j) {
                EXPECT_EQ(points[i] == points[j], numbers[i] == numbers[j]);
                int order = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    const auto c = static_cast<std::size_t>(axis);
                    const int expected = sgn(numbers[i][c] - numbers[j][c]);
                    EXPECT_EQ(sign(compare_coordinate(points[i], points[j], axis)), expected);
                    if (order == 0) order = expected;
                }
                EXPECT_EQ(sign(compare_lexicographic(points[i], points[j])), order);
            }
        }
    }
}

TEST(Point, EqualPointsHaveEqualDoubles) {
    // The same vertex, 1/3 of the way along an edge, by unrelated planes.
    const Plane p = Plane::axis_aligned(0, 3, 1);
    const Plane q = Plane::axis_aligned(1, 3, 2);
    const Plane r = Plane::axis_aligned(2, 7, 1);
    const Point a(p, q, r);
    const Point b(Plane(3, 3, 0, Plane::Coefficient(-3)), Plane(3, -3, 7, Plane::Coefficient(0)),
                  r);
    EXPECT_EQ(a, b);
    EXPECT_EQ(a.nearest(), b.nearest());
    EXPECT_EQ(a.nearest(), (std::array<double, 3>{1.0 / 3, 2.0 / 3, 1.0 / 7}));
    EXPECT_NE(a, Point(p, q, Plane::axis_aligned(2, 8, 1)));
    EXPECT_NE(a, Point(LatticePoint{0, 1, 0}));
}

// Points closer together than doubles can tell.
TEST(Point, NearlyEqualPointsAreOrdered) {
    const Plane y = Plane::axis_aligned(1, 1, 0);
    const Plane z = Plane::axis_aligned(2, 1, 0);
    const std::int64_t m = std::int64_t{1} << 61;
    const Point a(Plane::axis_aligned(0, m, m / 3), y, z);
    const Point b(Plane::axis_aligned(0, m - 1, m / 3), y, z);
    EXPECT_EQ(a.nearest(), b.nearest());
    EXPECT_NE(a, b);
    EXPECT_EQ(sign(compare_coordinate(a, b, 0)), -1);
    EXPECT_EQ(sign(compare_lexicographic(b, a)), 1);
}

TEST(Point, NearestIsCorrectlyRounded) {
    oracle::Source random(3);
    for (int round = 0; round < 3000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const Plane p = random.plane(bits);
        const Plane q = random.plane(bits);
        const Plane r = random.plane(bits);
        if (!meet_in_a_point(p, q, r)) continue;
        const auto x = oracle::rational(p, q, r);
        const auto d = Point(p, q, r).nearest();
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(d[i], oracle::nearest(x[i]));
    }
}

// Points of lattice triangles, as booleans make them, and planes that share an axis or a corner:
// doubles and one exact residual decide nearly always, and agree with the quotient of integers.
TEST(Point, NearestOfPlanesIsFilteredAndCorrectlyRounded) {
    oracle::Source random(6);
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    std::uint64_t count = 0;
    for (int round = 0; round < 20000; ++round) {
        const int bits = static_cast<int>(2 + random.below(52));
        const Plane p = random.plane(bits);
        const LatticePoint a = random.point(bits);
        const LatticePoint b = random.point(bits);
        const int axis = static_cast<int>(random.below(3));
        if (a[(axis + 1) % 3] == b[(axis + 1) % 3] && a[(axis + 2) % 3] == b[(axis + 2) % 3])
            continue;
        const Plane q = Plane::along_axis(a, b, axis);
        const LatticePoint c = random.point(bits);
        if (are_collinear(a, b, c)) continue;
        for (const Plane& r :
             {Plane::through(a, b, c), Plane::axis_aligned(axis, 256, 2 * b[axis] + 1),
              random.plane(bits)}) {
            const auto exact = intersect(p, q, r);
            if (!exact) continue;
            ++count;
            EXPECT_EQ(nearest_doubles(approximate(p, q, r), p, q, r), nearest_doubles(*exact));
        }
    }
    const auto counters = diagnostics.counters();
    EXPECT_LT(counters.exact_narrow + counters.exact_wide, count / 10);
}

void expect_nearest(const mpz_class& n, const mpz_class& d) {
    mpq_class q(n, d);
    q.canonicalize();
    EXPECT_EQ(nearest_double(oracle::register_of<17>(n), oracle::register_of<16>(d)),
              oracle::nearest(q))
        << n << " / " << d;
}

TEST(Point, NearestDoubleOfEveryLength) {
    oracle::Source random(4);
    const auto number = [&](std::uint64_t bits) {
        mpz_class v = 0;
        for (int i = 0; i < 6; ++i) v = (v << 64) + mpz_class(random.bits());
        return mpz_class((v >> (384 - bits)) | (mpz_class(1) << (bits - 1)));
    };
    for (int round = 0; round < 20000; ++round) {
        const mpz_class n = number(1 + random.below(384));
        const mpz_class d = number(1 + random.below(330));
        expect_nearest(random.coin() ? n : mpz_class(-n), d);
    }
    const mpz_class largest = (mpz_class(1) << 384) - 1;
    expect_nearest(largest, 1);
    expect_nearest(-largest, 1);
    expect_nearest(1, (mpz_class(1) << 330) - 1);
    expect_nearest(0, 5);
}

TEST(Point, NearestDoubleAtAndBesideTies) {
    oracle::Source random(5);
    for (int round = 0; round < 5000; ++round) {
        // (2m + 1) / 2 units in the last place, scaled; then a hair more and less.
        const mpz_class tie = (mpz_class(random.bits() >> 11 | std::uint64_t{1} << 52) << 1) + 1;
        const auto shift = random.below(200);
        const mpz_class d = mpz_class(random.bits() | 1) << random.below(200);
        const mpz_class n = (tie * d) << shift;
        for (int off = -1; off <= 1; ++off) {
            if (mpz_sizeinbase(n.get_mpz_t(), 2) > 383) continue;
            expect_nearest(n + off, d);
            expect_nearest(-n + off, d);
        }
    }
    // Rounding up into the next power of two.
    const mpz_class ones = (mpz_class(1) << 60) - 1;
    expect_nearest(ones, 1);
    expect_nearest(ones, mpz_class(1) << 100);
    expect_nearest(ones << 200, 3);
}

TEST(Point, CopiesShareTheirName) {
    const Point a(Plane::axis_aligned(0, 2, 1), Plane::axis_aligned(1, 2, 1),
                  Plane::axis_aligned(2, 2, 1));
    const Point b = a;  // NOLINT(performance-unnecessary-copy-initialization)
    EXPECT_EQ(a.plane_point(), b.plane_point());
    EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace point_test
