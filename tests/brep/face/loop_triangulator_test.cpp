// SPDX-License-Identifier: Apache-2.0
//
// Any closed loop on a small grid, folded and crossing itself as it may be: the boundaries of its
// triangles add up to the loop, step by step between grid points, and triangles that do not fold
// have the area that the loop has.

#include <trisect/brep/face/loop_triangulator.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>

#include "support/lattice_arithmetic.h"

namespace {

using trisect::are_collinear;
using trisect::LatticePoint;
using trisect::detail::LoopShape;
using trisect::detail::LoopTriangulator;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Segments between neighbouring grid points of a line, signed: equal chains of points are equal.
using Steps = std::map<std::array<LatticePoint, 2>, int>;

void add_side(Steps& steps, const LatticePoint& from, const LatticePoint& to, int sign) {
    const LatticePoint d = to - from;
    const std::int64_t n = std::gcd(std::gcd(d.x.to_integer(), d.y.to_integer()), d.z.to_integer());
    LatticePoint at = from;
    for (std::int64_t i = 0; i < n; ++i) {
        const LatticePoint next{at.x + d.x / n, at.y + d.y / n, at.z + d.z / n};
        const bool forward = at < next;
        const LatticePoint& a = forward ? at : next;
        const LatticePoint& b = forward ? next : at;
        const std::array<LatticePoint, 2> key{a, b};
        if ((steps[key] += forward ? sign : -sign) == 0) steps.erase(key);
        at = next;
    }
}

template <class Loop>
void add_loop(Steps& steps, const std::vector<LatticePoint>& points, const Loop& loop, int sign) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        add_side(steps, points[loop[i]], points[loop[(i + 1) % loop.size()]], sign);
}

// Twice the area in the plane z = 0.
template <class Loop>
std::int64_t area(const std::vector<LatticePoint>& points, const Loop& loop) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const LatticePoint& a = points[loop[i]];
        const LatticePoint& b = points[loop[(i + 1) % loop.size()]];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

TEST(LoopTriangulator, LoopsOnASmallGridAreTheSumOfTheirTriangles) {
    std::mt19937 random(11);  // NOLINT
    int simple = 0;
    int folded = 0;
    int degenerate = 0;
    for (int round = 0; round < 20000; ++round) {
        const std::size_t n = 3 + random() % 8;
        const std::int64_t side = round % 3 == 0 ? 3 : 5;
        const bool flat = round % 4 != 0;
        std::vector<LatticePoint> points;
        while (points.size() < n) {
            const auto coordinate = [&] {
                return static_cast<std::int64_t>(random() % static_cast<unsigned>(side));
            };
            const LatticePoint p{coordinate(), coordinate(), flat ? 0 : coordinate() / 2};
            if (points.empty() || (p != points.back() && (points.size() + 1 < n || p != points[0])))
                points.push_back(p);
        }
        std::vector<std::uint32_t> loop(n);
        std::iota(loop.begin(), loop.end(), 0U);
        LoopTriangulator triangulator(points);
        Triangles triangles;
        const LoopShape shape = triangulator.triangulate(loop, triangles);
        if (shape.degenerate) {
            EXPECT_TRUE(triangles.empty());
            ++degenerate;
            continue;
        }
        Steps difference;
        add_loop(difference, points, loop, 1);
        for (const auto& t : triangles) {
            EXPECT_FALSE(are_collinear(points[t[0]], points[t[1]], points[t[2]]));
            add_loop(difference, points, t, -1);
        }
        EXPECT_TRUE(difference.empty()) << "round " << round;
        if (!flat) continue;
        EXPECT_TRUE(shape.planar);
        std::int64_t sum = 0;
        for (const auto& t : triangles) sum += std::abs(area(points, t));
        if (shape.simple) {
            EXPECT_EQ(sum, std::abs(area(points, loop))) << "round " << round;
        }
        ++(shape.simple ? simple : folded);
    }
    EXPECT_GT(simple, 3000);
    EXPECT_GT(folded, 3000);
    EXPECT_GT(degenerate, 30);
}

TEST(LoopTriangulator, FigureOfEightWithoutAreaFolds) {
    const std::vector<LatticePoint> points{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
    Triangles triangles;
    const LoopShape shape =
        LoopTriangulator(points).triangulate(std::array<std::uint32_t, 4>{0, 1, 2, 3}, triangles);
    EXPECT_FALSE(shape.simple);
    EXPECT_EQ(triangles.size(), 2U);
}

TEST(LoopTriangulator, MoreCornersThanSumsHaveBitsFor) {
    std::vector<std::uint32_t> loop(trisect::detail::loop_corner_limit + 1, 0);
    const std::vector<LatticePoint> points{{0, 0, 0}};
    Triangles triangles;
    EXPECT_THROW(LoopTriangulator(points).triangulate(loop, triangles), trisect::LimitError);
}

}  // namespace
