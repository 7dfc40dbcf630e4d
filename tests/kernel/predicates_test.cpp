// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/predicates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/point.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace predicates_test {
namespace {

using trisect::Approximation;
using trisect::Diagnostics;
using trisect::HomogeneousPoint;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::PredicateCounters;
using trisect::Side;

const Approximation vague{{0, 0, 0}, 1e300};  // forces the later stages

// Four planes of one size, on small grids often through common points, lines or each other.
std::array<Plane, 4> four_planes(oracle::Source& random) {
    const std::array<int, 8> sizes{1, 2, 3, 10, 25, 26, 40, 53};
    const int bits = sizes[random.below(sizes.size())];
    return {random.plane(bits), random.plane(bits), random.plane(bits), random.plane(bits)};
}

// ---------------------------------------------------------------- laws

TEST(Laws, SideFlipsWithThePlane) {
    oracle::Source random(1);
    for (int round = 0; round < 5000; ++round) {
        const auto [p, q, r, s] = four_planes(random);
        const LatticePoint x = random.point(static_cast<int>(1 + random.below(53)));
        EXPECT_EQ(side_of(x, s.flipped()), opposite(side_of(x, s)));
        if (!meet_in_a_point(p, q, r)) continue;
        const Approximation a = approximate(p, q, r);
        const HomogeneousPoint h = *intersect(p, q, r);
        const Side side = side_of(a, p, q, r, s);
        EXPECT_EQ(side_of(a, p, q, r, s.flipped()), opposite(side));
        EXPECT_EQ(side_of(vague, p, q, r, s.flipped()), opposite(side));
        EXPECT_EQ(side_of(h, s.flipped()), opposite(side));
        EXPECT_EQ(side_of(h, s), side);
    }
}

TEST(Laws, AnyOrderAndOrientationNamesTheSamePoint) {
    oracle::Source random(2);
    for (int round = 0; round < 1500; ++round) {
        auto planes = four_planes(random);
        if (!meet_in_a_point(planes[0], planes[1], planes[2])) continue;
        const auto expected = oracle::rational(planes[0], planes[1], planes[2]);
        const auto side = static_cast<Side>(oracle::side(expected, planes[3]));
        std::array<std::size_t, 3> order{0, 1, 2};
        do {
            for (unsigned flips = 0; flips < 8; ++flips) {
                std::array<Plane, 3> n;
                for (std::size_t i = 0; i < 3; ++i)
                    n[i] = (flips >> i & 1U) != 0 ? planes[order[i]].flipped() : planes[order[i]];
                const auto h = intersect(n[0], n[1], n[2]);
                ASSERT_TRUE(h.has_value());
                EXPECT_EQ(h->w.sign(), 1);
                EXPECT_EQ(oracle::rational(*h), expected);
                EXPECT_EQ(side_of(vague, n[0], n[1], n[2], planes[3]), side);
            }
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(Laws, DeterminantAlternates) {
    oracle::Source random(3);
    for (int round = 0; round < 5000; ++round) {
        const auto [p, q, r, s] = four_planes(random);
        const int d = sign_of_det(p, q, r);
        EXPECT_EQ(
            d, sgn(oracle::det3(oracle::numbers(p).n, oracle::numbers(q).n, oracle::numbers(r).n)));
        EXPECT_EQ(sign_of_det(q, r, p), d);
        EXPECT_EQ(sign_of_det(q, p, r), -d);
        EXPECT_EQ(sign_of_det(p.flipped(), q, r), -d);
        EXPECT_EQ(sign_of_det(p, p, s), 0);
        EXPECT_EQ(sign_of_det(p, s, s.flipped()), 0);
        EXPECT_EQ(meet_in_a_point(p, q, r), d != 0);
        EXPECT_EQ(intersect(p, q, r).has_value(), d != 0);
    }
}

TEST(Laws, CrossAndDot) {
    oracle::Source random(4);
    for (int round = 0; round < 5000; ++round) {
        const auto [p, q, r, s] = four_planes(random);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(sign_of_cross(p, q, axis), -sign_of_cross(q, p, axis));
            EXPECT_EQ(sign_of_cross(p.flipped(), q, axis), -sign_of_cross(p, q, axis));
            EXPECT_EQ(sign_of_cross(p, p, axis), 0);
            EXPECT_EQ(sign_of_cross(p, p.flipped(), axis), 0);
            const auto a = oracle::numbers(r).n;
            const auto b = oracle::numbers(s).n;
            const auto j = static_cast<std::size_t>((axis + 1) % 3);
            const auto l = static_cast<std::size_t>((axis + 2) % 3);
            EXPECT_EQ(sign_of_cross(r, s, axis), sgn(mpz_class(a[j] * b[l] - a[l] * b[j])));
        }
        EXPECT_EQ(sign_of_dot(p, q), sign_of_dot(q, p));
        EXPECT_EQ(sign_of_dot(p.flipped(), q), -sign_of_dot(p, q));
        EXPECT_EQ(sign_of_dot(p, p), 1);
        const auto a = oracle::numbers(p).n;
        const auto b = oracle::numbers(q).n;
        EXPECT_EQ(sign_of_dot(p, q), sgn(mpz_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])));
    }
}

TEST(Laws, SamePlaneWhateverTheCoefficients) {
    oracle::Source random(5);
    for (int round = 0; round < 3000; ++round) {
        const int bits = static_cast<int>(2 + random.below(49));
        const LatticePoint a = random.point(bits);
        const LatticePoint u = random.point(bits);
        const LatticePoint v = random.point(bits);
        if (are_collinear(a, a + u, a + v)) continue;
        const auto times = [](std::int64_t k, LatticePoint p) {
            return LatticePoint{k * p.x, k * p.y, k * p.z};
        };
        const Plane p = Plane::through(a, a + u, a + v);
        const Plane q = Plane::through(a + v, a + times(3, u), a + times(-2, v));
        EXPECT_TRUE(is_same_plane(p, q));
        EXPECT_TRUE(is_same_plane(q, p.flipped()));
        EXPECT_EQ(same_orientation(p, q), !same_orientation(p.flipped(), q));
        // One unit off is another plane, parallel or not.
        const LatticePoint e{0, 0, 1};
        const Plane off = Plane::through(a + e, a + u + e, a + v + e);
        EXPECT_EQ(is_same_plane(p, off), p.normal(2) == 0);
        EXPECT_FALSE(is_same_plane(
            p, Plane(p.normal(0), p.normal(1), p.normal(2), p.offset() + Plane::Coefficient(1))));
    }
}

// One coordinate is much larger than the others: the filter scales by the largest one.
TEST(Laws, PointsFarAlongOneAxisAreRoundedByTheFilter) {
    for (int far = 0; far < 3; ++far) {
        std::array<Plane, 3> planes;
        for (int axis = 0; axis < 3; ++axis)
            planes[static_cast<std::size_t>(axis)] =
                Plane::axis_aligned(axis, 3, axis == far ? (std::int64_t{1} << 50) + 1 : 1);
        const auto& [p, q, r] = planes;
        const Approximation a = approximate(p, q, r);
        const auto expected = oracle::rational(p, q, r);
        const Diagnostics<PredicateCounters> diagnostics;
        const auto nearest = nearest_doubles(a, p, q, r);
        EXPECT_EQ(diagnostics.counters().filtered, 1U);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(nearest[i], oracle::nearest(expected[i]));
    }
}

// Through three corners, through two of them along an axis, on small grids and on large ones.
TEST(Laws, PlanesByTheirCornersRoundPointsAsMadeOnesDo) {
    oracle::Source random(31);
    const std::array<int, 6> sizes{3, 10, 25, 40, 52, 53};
    int met = 0;
    int known = 0;
    for (int round = 0; round < 20000; ++round) {
        const int bits = sizes[random.below(sizes.size())];
        std::array<LatticePoint, 9> corners;
        for (LatticePoint& c : corners) c = random.point(bits);
        std::array<trisect::CornerPlane, 3> by_corners;
        std::array<Plane, 3> planes;
        bool flat = false;
        for (std::size_t i = 0; i < 3 && !flat; ++i) {
            const LatticePoint* const c = &corners[3 * i];
            flat = are_collinear(c[0], c[1], c[2]);
            if (flat) break;
            by_corners[i] = {{c, c + 1, c + 2}, -1};
            planes[i] = Plane::through(c[0], c[1], c[2]);
            if (random.below(3) != 0) continue;
            const auto axis = static_cast<int>(random.below(3));
            flat = c[0][(axis + 1) % 3] == c[1][(axis + 1) % 3] &&
                   c[0][(axis + 2) % 3] == c[1][(axis + 2) % 3];
            if (flat) break;
            by_corners[i].axis = axis;
            planes[i] = Plane::along_axis(c[0], c[1], axis);
        }
        if (flat || !meet_in_a_point(planes[0], planes[1], planes[2])) continue;
        const Approximation a = approximate(planes[0], planes[1], planes[2]);
        const auto nearest = nearest_doubles(a, by_corners);
        ++met;
        if (!nearest) continue;
        ++known;
        EXPECT_EQ(*nearest, nearest_doubles(a, planes[0], planes[1], planes[2]));
    }
    EXPECT_GT(met, 15000);
    EXPECT_GT(known, met / 2);
}

// A corner with bits behind the point, as many in each coordinate as it likes.
LatticePoint fine_point(oracle::Source& random, int bits) {
    std::array<double, 3> c{};
    for (double& v : c) {
        const auto down = static_cast<int>(random.below(74));
        const LatticePoint p = random.point(bits);
        v = std::ldexp(p[0].to_double(), -down);
    }
    return {trisect::Coordinate(c[0]), trisect::Coordinate(c[1]), trisect::Coordinate(c[2])};
}

struct FinePlane {
    std::array<LatticePoint, 3> corners;
    Plane plane;
    trisect::CornerPlane by_corners;
};

// Through corners, along an axis, or made; `axis`: that of sides of prisms, which is one of its
// edges. False where corners are on one line.
bool make_fine_plane(oracle::Source& random, int bits, FinePlane& out) {
    auto& c = out.corners;
    for (LatticePoint& p : c) p = fine_point(random, bits);
    const auto axis = static_cast<int>(random.below(3));
    if (random.below(4) == 0) {  // the side of a prism
        std::array<trisect::Coordinate, 3> beside{c[0][0], c[0][1], c[0][2]};
        beside[static_cast<std::size_t>(axis)] = c[2][axis];
        c[2] = {beside[0], beside[1], beside[2]};
    }
    if (are_collinear(c[0], c[1], c[2])) return false;
    out.plane = Plane::through(c[0], c[1], c[2]);
    out.by_corners = {{&c[0], &c[1], &c[2]}, -1, false, nullptr};
    if (random.below(4) == 0) out.by_corners.made = &out.plane;
    if (random.below(3) != 0) return true;
    if (c[0][(axis + 1) % 3] == c[1][(axis + 1) % 3] &&
        c[0][(axis + 2) % 3] == c[1][(axis + 2) % 3])
        return false;
    out.by_corners.axis = axis;
    out.plane = Plane::along_axis(c[0], c[1], axis);
    return true;
}

TEST(Laws, PlanesByCornersWithFractionsRoundPointsAsMadeOnesDo) {
    oracle::Source random(32);
    const std::array<int, 5> sizes{3, 12, 30, 45, 53};
    int met = 0;
    int known = 0;
    for (int round = 0; round < 20000; ++round) {
        const int bits = sizes[random.below(sizes.size())];
        std::array<FinePlane, 3> planes;
        bool flat = false;
        for (FinePlane& p : planes) flat = flat || !make_fine_plane(random, bits, p);
        if (flat || !meet_in_a_point(planes[0].plane, planes[1].plane, planes[2].plane)) continue;
        const Approximation a = approximate(planes[0].plane, planes[1].plane, planes[2].plane);
        const auto nearest =
            nearest_doubles(a, {planes[0].by_corners, planes[1].by_corners, planes[2].by_corners});
        ++met;
        if (!nearest) continue;
        ++known;
        EXPECT_EQ(*nearest,
                  nearest_doubles(*intersect(planes[0].plane, planes[1].plane, planes[2].plane)));
    }
    EXPECT_GT(met, 10000);
    EXPECT_GT(known, met / 2);
}

// Half-spaces across an axis: the coordinate along it is known though it may be 0.
TEST(Laws, EdgesOfFineCornersPierceMadePlanesAcrossAxes) {
    oracle::Source random(33);
    int known = 0;
    int met = 0;
    for (int round = 0; round < 3000; ++round) {
        std::array<FinePlane, 2> facets;
        if (!make_fine_plane(random, 50, facets[0]) || !make_fine_plane(random, 50, facets[1]))
            continue;
        const auto axis = static_cast<int>(random.below(3));
        const Plane across =
            Plane::axis_aligned(axis, 1, static_cast<std::int64_t>(random.below(3)) - 1);
        if (!meet_in_a_point(facets[0].plane, facets[1].plane, across)) continue;
        trisect::CornerPlane made;
        made.made = &across;
        const Approximation a = approximate(facets[0].plane, facets[1].plane, across);
        const auto nearest = nearest_doubles(a, {facets[0].by_corners, facets[1].by_corners, made});
        ++met;
        if (!nearest) continue;
        ++known;
        EXPECT_EQ(*nearest, nearest_doubles(*intersect(facets[0].plane, facets[1].plane, across)));
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(known, met / 2);
}

// ---------------------------------------------------------------- coverage of the stages

PredicateCounters counted(const auto& predicate) {
    const Diagnostics<PredicateCounters> diagnostics;
    predicate();
    return diagnostics.counters();
}

TEST(Coverage, LatticePoint) {
    const Plane narrow = Plane::through({0, 0, 0}, {3, 1, 5}, {1, 7, 2});
    EXPECT_EQ(counted([&] { (void)side_of(LatticePoint{9, 9, 99}, narrow); }).filtered, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(LatticePoint{3, 1, 5}, narrow); }).exact_narrow, 1U);
    const std::int64_t f = trisect::coordinate_limit - 1;
    const Plane wide = Plane::through({f, -f, 3}, {-f, 7, f}, {5, f, f - 9});
    EXPECT_EQ(counted([&] { (void)side_of(LatticePoint{f, -f, 3}, wide); }).exact_wide, 1U);
    EXPECT_EQ(side_of(LatticePoint{f, -f, 3}, wide), Side::On);
    EXPECT_NE(side_of(LatticePoint{f, -f, 4}, wide), Side::On);
}

TEST(Coverage, PointOfPlanes) {
    const Plane p = Plane::through({0, 0, 0}, {7, 0, 1}, {0, 7, 2});
    const Plane q = Plane::through({1, 0, 0}, {2, 5, 0}, {1, 1, 7});
    const Plane r = Plane::through({0, 1, 0}, {5, 2, 0}, {0, 1, 9});
    const Approximation a = approximate(p, q, r);
    const Plane clear = Plane::axis_aligned(0, 1, 100);
    EXPECT_EQ(counted([&] { (void)side_of(a, p, q, r, clear); }).filtered, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(a, p, q, r, q); }).symbolic, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(a, p, q, r, r.flipped()); }).exact_narrow, 1U);
    const Plane huge(p.normal(0).shifted_left(60), p.normal(1).shifted_left(60),
                     p.normal(2).shifted_left(60), p.offset().shifted_left(60));
    ASSERT_FALSE(huge.is_narrow());
    const PredicateCounters c = counted([&] {
        EXPECT_EQ(side_of(a, p, q, r, huge), Side::On);
        EXPECT_EQ(side_of(a, huge, q, r, p), Side::On);
    });
    EXPECT_EQ(c.exact_wide, 2U);
    EXPECT_EQ(c.total(), 2U);
    const HomogeneousPoint h = *intersect(p, q, r);
    EXPECT_EQ(counted([&] { (void)side_of(h, p); }).exact_narrow, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(h, huge); }).exact_wide, 1U);
    const Point named(p, q, r);
    ASSERT_FALSE(named.is_lattice());
    EXPECT_EQ(counted([&] { (void)side_of(named, clear); }).filtered, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(named, p); }).symbolic, 1U);
    EXPECT_EQ(counted([&] { (void)side_of(named, p.flipped()); }).exact_narrow, 1U);
}

TEST(Coverage, SignsOfPlanes) {
    const Plane p = Plane::through({0, 0, 0}, {7, 0, 1}, {0, 7, 2});
    const Plane x = Plane::axis_aligned(0, 1, 0);
    const Plane y = Plane::axis_aligned(1, 1, 0);
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_cross(x, y, 2), 1); }).filtered, 1U);
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_cross(x, y, 0), 0); }).filtered, 1U);
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_cross(p, p, 0), 0); }).exact_narrow, 1U);
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_det(p, p, x), 0); }).exact_narrow, 1U);
    const Plane a(3, 5, 0, Plane::Coefficient(0));
    const Plane b(5, -3, 0, Plane::Coefficient(0));
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_dot(a, b), 0); }).exact_narrow, 1U);
    EXPECT_EQ(counted([&] { EXPECT_EQ(sign_of_dot(a, a), 1); }).filtered, 1U);
}

// The filter must decide nearly everything on inputs in general position.
TEST(Coverage, TheFilterDecidesGeneralPosition) {
    oracle::Source random(6);
    const Diagnostics<PredicateCounters> diagnostics;
    for (int round = 0; round < 2000; ++round) {
        const int bits = static_cast<int>(20 + random.below(34));
        const Plane p = random.plane(bits);
        const Plane q = random.plane(bits);
        const Plane r = random.plane(bits);
        const Plane s = random.plane(bits);
        (void)side_of(approximate(p, q, r), p, q, r, s);
        (void)side_of(random.point(bits), s);
        (void)sign_of_det(p, q, r);
    }
    const PredicateCounters c = diagnostics.counters();
    EXPECT_EQ(c.total(), 6000U);
    EXPECT_GE(c.filtered, 5990U);
}

// A scope counts what is done while it lives, whatever there is around it, in its own thread alone.
TEST(Coverage, DiagnosticsNestAndAreOfOneThread) {
    const auto decide = [] { (void)side_of(LatticePoint{3, 4, 5}, Plane::axis_aligned(0, 1, 7)); };
    const Diagnostics<PredicateCounters> outer;
    decide();
    const Diagnostics<PredicateCounters> inner;
    EXPECT_EQ(inner.counters().total(), 0U);
    decide();
    std::thread([&] {
        const Diagnostics<PredicateCounters> other;
        for (int i = 0; i < 3; ++i) decide();
        EXPECT_EQ(other.counters().total(), 3U);
    }).join();
    EXPECT_EQ(inner.counters().total(), 1U);
    EXPECT_EQ(outer.counters().total(), 2U);
    EXPECT_EQ(outer.counters().total(), 2U);  // looking at them counts nothing
}

TEST(Coverage, CountersAddUp) {
    PredicateCounters a{1, 2, 3, 4};
    a += PredicateCounters{10, 20, 30, 40};
    EXPECT_EQ(a.symbolic, 11U);
    EXPECT_EQ(a.filtered, 22U);
    EXPECT_EQ(a.exact_narrow, 33U);
    EXPECT_EQ(a.exact_wide, 44U);
    EXPECT_EQ(a.total(), 110U);
}

// ---------------------------------------------------------------- consistency

TEST(Consistency, AllNamesOfALatticePointAgree) {
    oracle::Source random(7);
    for (int round = 0; round < 5000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const LatticePoint x = random.point(bits);
        const Plane px = Plane::axis_aligned(0, 1, x.x.to_integer());
        const Plane py = Plane::axis_aligned(1, 1, x.y.to_integer());
        const Plane pz = Plane::axis_aligned(2, 1, x.z.to_integer());
        const Plane s = random.coin() ? random.plane(bits) : [&] {
            for (;;) {
                const LatticePoint b = random.point(bits);
                const LatticePoint c = random.point(bits);
                if (!are_collinear(x, b, c)) return Plane::through(x, b, c);
            }
        }();
        const Side side = side_of(x, s);
        EXPECT_EQ(static_cast<int>(side), oracle::side(oracle::rational(x), s));
        EXPECT_EQ(side_of(*intersect(px, py, pz), s), side);
        EXPECT_EQ(side_of(vague, px, py, pz, s), side);
        EXPECT_EQ(side_of(approximate(px, py, pz), px, py, pz, s), side);
        EXPECT_EQ(side_of(Point(px, py, pz), s), side);
        EXPECT_EQ(side_of(Point(x), s), side);
    }
}

TEST(Consistency, TheFilterNeverContradictsTheExactStage) {
    oracle::Source random(8);
    for (int round = 0; round < 5000; ++round) {
        const auto [p, q, r, s] = four_planes(random);
        if (!meet_in_a_point(p, q, r)) continue;
        const auto x = oracle::rational(p, q, r);
        const HomogeneousPoint h = *intersect(p, q, r);
        for (const Approximation& a : {approximate(p, q, r), approximate(h)}) {
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_LE(abs(x[i] - mpq_class(a.c[i])), mpq_class(a.error));
            for (const Plane& plane : {p, q, r, s}) {
                const auto f = filtered_side(a, plane);
                if (f) {
                    EXPECT_EQ(static_cast<int>(*f), oracle::side(x, plane));
                }
            }
        }
    }
}

// Planes that are parallel to one of the point's, or that plane by other corners.
TEST(Consistency, SidesOfParallelPlanesAreThoseOfTheExactPoint) {
    oracle::Source random(97);
    int on = 0;
    for (int round = 0; round < 5000; ++round) {
        const int bits = static_cast<int>(2 + random.below(40));
        std::array<LatticePoint, 3> c;
        for (LatticePoint& x : c) x = random.point(bits);
        if (round % 3 == 0) c[1].z = c[2].z = c[0].z;
        if (trisect::are_collinear(c[0], c[1], c[2])) continue;
        const LatticePoint shift = round % 2 == 0 ? LatticePoint{0, 0, 0} : random.point(bits);
        const auto along = [&](int i, int j) {
            const auto at = [&](int k) {
                const auto of = [&](const LatticePoint& x) { return x[k].to_integer(); };
                return of(c[0]) + of(shift) + i * (of(c[1]) - of(c[0])) + j * (of(c[2]) - of(c[0]));
            };
            return LatticePoint{at(0), at(1), at(2)};
        };
        const Plane p = Plane::through(c[0], c[1], c[2]);
        const Plane s = round % 5 == 0 ? Plane::through(along(0, 0), along(2, 3), along(3, 1))
                                       : Plane::through(along(1, 1), along(3, 2), along(0, 3));
        const Plane q = random.plane(bits);
        const Plane r = random.plane(bits);
        if (!meet_in_a_point(p, q, r)) continue;
        const Side side = side_of(*intersect(p, q, r), s);
        EXPECT_EQ(side_of(vague, p, q, r, s), side);
        EXPECT_EQ(side_of(vague, q, r, p, s), side);
        on += side == Side::On ? 1 : 0;
    }
    EXPECT_GT(on, 1000);
}

TEST(Consistency, CompareCoordinateIsTheOrderOfNumbers) {
    oracle::Source random(9);
    for (int round = 0; round < 3000; ++round) {
        const auto [p, q, r, s] = four_planes(random);
        const auto a = intersect(p, q, r);
        const auto b = intersect(p, q, s);
        if (!a || !b) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const int expected = cmp(oracle::rational(*a)[i], oracle::rational(*b)[i]);
            const auto order = compare_coordinate(*a, *b, axis);
            EXPECT_EQ(order < 0 ? -1 : (order > 0 ? 1 : 0),
                      expected > 0 ? 1 : (expected < 0 ? -1 : 0));
            EXPECT_TRUE(compare_coordinate(*a, *a, axis) == 0);
        }
    }
}

TEST(Consistency, ApproximatingParallelPlanesIsRefused) {
    const Plane a = Plane::axis_aligned(0, 1, 0);
    const Plane b = Plane::axis_aligned(0, 1, 1);
    const Plane c = Plane::axis_aligned(1, 1, 1);
    EXPECT_FALSE(intersect(a, b, c).has_value());
    EXPECT_THROW((void)approximate(a, b, c), trisect::Error);
}

}  // namespace
}  // namespace predicates_test
