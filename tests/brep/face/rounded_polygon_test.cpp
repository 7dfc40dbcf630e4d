// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/face/rounded_polygon.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/planar_loops.h>

#include "support/lattice_arithmetic.h"

namespace {

using namespace trisect;
using detail::RoundedPolygon;

constexpr std::uint64_t seed = 20261122;

class Random {
public:
    std::int64_t below(std::int64_t n) {
        return std::uniform_int_distribution<std::int64_t>(-n, n)(engine_);
    }
    LatticePoint point(std::int64_t n) { return {below(n), below(n), below(n)}; }
    Plane plane(std::int64_t n) {
        for (;;) {
            const LatticePoint a = point(n);
            const LatticePoint b = point(n);
            const LatticePoint c = point(n);
            if (!are_collinear(a, b, c)) return Plane::through(a, b, c);
        }
    }

private:
    std::mt19937_64 engine_{seed};
};

RoundedPolygon rounded(const std::vector<Point>& points, PlaneProjection::Axes axes) {
    RoundedPolygon out;
    out.clear();
    for (const Point& p : points) {
        const auto c = p.nearest();
        const double u = c[static_cast<std::size_t>(axes.u)];
        const double v = c[static_cast<std::size_t>(axes.v)];
        if (p.is_lattice()) {
            out.add(u, v, 0);
        } else {
            out.add_nearest(u, v);
        }
    }
    return out;
}

int exact_turn(const std::vector<Point>& p, PlaneProjection::Axes axes) {
    return PlaneProjection::exact_orientation(p[0].homogeneous(), p[1].homogeneous(),
                                              p[2].homogeneous(), axes);
}

TEST(RoundedPolygon, TurnsBetweenPointsOfPlanesAgreeWithTheExactOnes) {
    Random random;
    for (int round = 0; round < 2000; ++round) {
        const std::int64_t size = std::int64_t{1} << (round % 2 == 0 ? 4 : 50);
        const Plane support = random.plane(size);
        const auto axes = PlaneProjection::axes_of(support, round % 3 == 0);
        std::vector<Point> points;
        while (points.size() < 3) {
            const Plane p = random.plane(size);
            const Plane q = random.plane(size);
            if (meet_in_a_point(support, p, q)) points.emplace_back(support, p, q);
        }
        const int s = rounded(points, axes).turn(0, 1, 2);
        if (s == 0) continue;
        EXPECT_EQ(s, exact_turn(points, axes)) << "round " << round;
    }
}

HomogeneousPoint in_second_tier(HomogeneousPoint p) {
    p.tier = std::max(p.tier, 1);
    return p;
}

// The narrow determinant, also of points on one line and of corners of the lattice.
TEST(RoundedPolygon, ExactTurnsDoNotDependOnTheTier) {
    Random random;
    int narrow = 0;
    int straight = 0;
    for (int round = 0; round < 1000; ++round) {
        const std::int64_t size = std::int64_t{1} << (round % 2 == 0 ? 4 : 26);
        const Plane support = random.plane(size);
        const Plane common = random.plane(size);
        std::vector<HomogeneousPoint> points;
        while (points.size() < 3) {
            const Plane p = round % 3 == 0 ? common : random.plane(size);
            if (const auto at = intersect(support, p, random.plane(size))) points.push_back(*at);
        }
        if (round % 5 == 0) points[0] = homogeneous(random.point(size));
        const auto axes = PlaneProjection::axes_of(support, round % 7 == 0);
        const int turn = PlaneProjection::exact_orientation(points[0], points[1], points[2], axes);
        narrow += std::ranges::all_of(points, [](const auto& p) { return p.tier == 0; }) ? 1 : 0;
        straight += turn == 0 ? 1 : 0;
        EXPECT_EQ(turn, PlaneProjection::exact_orientation(in_second_tier(points[0]),
                                                           in_second_tier(points[1]),
                                                           in_second_tier(points[2]), axes))
            << "round " << round;
    }
    EXPECT_GT(narrow, 400);
    EXPECT_GT(straight, 200);
}

// Two cuts by the halves of a quadrangle that is out of its plane by one unit of the lattice.
TEST(RoundedPolygon, AlmostStraightCornerOfTwoNearlyCoplanarCutsIsDecided) {
    Random random;
    const std::int64_t size = std::int64_t{1} << 40;
    int undecided = 0;
    int undecided_before = 0;
    int rounds = 0;
    while (rounds < 500) {
        const Plane support = random.plane(size);
        const LatticePoint a = random.point(size);
        const LatticePoint b = random.point(size);
        const LatticePoint c = random.point(size);
        const LatticePoint d = a + (c - b) + LatticePoint{1, 0, 0};
        if (are_collinear(a, b, c) || are_collinear(a, c, d)) continue;
        const Plane first = Plane::through(a, b, c);
        const Plane second = Plane::through(a, c, d);
        const Plane side = random.plane(size);
        const Plane other = random.plane(size);
        if (!meet_in_a_point(support, first, second)) continue;
        const std::vector<Point> points{Point(support, first, side), Point(support, first, second),
                                        Point(support, second, other)};
        const auto axes = PlaneProjection::axes_of(support);
        const int exact = exact_turn(points, axes);
        const int s = rounded(points, axes).turn(0, 1, 2);
        EXPECT_TRUE(s == 0 || s == exact);
        ++rounds;
        if (s == 0 && exact != 0) ++undecided;
        if (exact != 0 &&
            PlaneProjection::filtered_orientation(approximate(support, first, side),
                                                  approximate(support, first, second),
                                                  approximate(support, second, other), axes) == 0)
            ++undecided_before;
    }
    EXPECT_LT(5 * undecided, undecided_before) << undecided << " beside " << undecided_before;
}

TEST(RoundedPolygon, CornersOnOneLineAreLeftOpen) {
    Random random;
    for (int round = 0; round < 500; ++round) {
        const std::int64_t size = std::int64_t{1} << 40;
        const Plane support = random.plane(size);
        const Plane line = random.plane(size);
        const std::vector<Point> points{Point(support, line, random.plane(size)),
                                        Point(support, line, random.plane(size)),
                                        Point(support, line, random.plane(size))};
        EXPECT_EQ(rounded(points, PlaneProjection::axes_of(support)).turn(0, 1, 2), 0);
    }
}

TEST(RoundedPolygon, CornersOfTheLatticeAreDecidedDownToTheSmallestTriangle) {
    RoundedPolygon p;
    p.clear();
    p.add(0, 0, 0);
    p.add(0x1p20 + 1, 0x1p20, 0);
    p.add(0x1p20 + 2, 0x1p20 + 1, 0);
    EXPECT_EQ(p.turn(0, 1, 2), 1);
    EXPECT_EQ(p.turn(2, 1, 0), -1);
    EXPECT_EQ(p.size(), 3U);
}

}  // namespace
