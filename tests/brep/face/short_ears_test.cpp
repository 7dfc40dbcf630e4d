// SPDX-License-Identifier: Apache-2.0
//
// Large loops: every corner is used, no triangle is flat or turned over, areas add up, and ears are
// compared with few corners.

#include <trisect/brep/face/short_ears.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "support/lattice_arithmetic.h"

namespace {

using trisect::detail::FlatCorner;
using trisect::detail::ShortEars;
using trisect::detail::turn;
using Loop = std::vector<FlatCorner>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double pi = 3.14159265358979323846;

// Corners on rays from the origin, in order: simple, whatever the radii.
template <class Radius>
Loop star_shaped(std::uint32_t corners, const Radius& radius) {
    Loop loop;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        const double r = radius(i);
        loop.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
    }
    return loop;
}

Loop star(std::uint32_t corners) {
    return star_shaped(corners, [](std::uint32_t i) { return i % 2 == 0 ? 0x1p40 : 0x1p39; });
}

// Teeth upwards from a bar.
Loop comb(std::uint32_t teeth, std::int64_t height) {
    Loop loop{{0, 0}, {4 * std::int64_t{teeth}, 0}};
    for (std::int64_t t = teeth; t > 0; --t) {
        loop.push_back({4 * t, height});
        loop.push_back({4 * t - 1, height});
        loop.push_back({4 * t - 1, 10});
        if (t > 1) loop.push_back({4 * t - 4, 10});
    }
    loop.push_back({0, 10});
    return loop;
}

// Two arms around each other, with corners that spread along them.
Loop spiral(std::uint32_t corners) {
    Loop loop;
    const auto at = [&](std::uint32_t i, double shift) {
        const double angle = 0.05 * i;
        const double r = (10 + angle + shift) * 0x1p30;
        return FlatCorner{std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))};
    };
    for (std::uint32_t i = 0; i < corners / 2; ++i) loop.push_back(at(i, 3));
    for (std::uint32_t i = corners / 2; i-- > 0;) loop.push_back(at(i, 0));
    return loop;
}

double area(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    return 0.5 * (static_cast<double>(b.u - a.u) * static_cast<double>(c.v - a.v) -
                  static_cast<double>(b.v - a.v) * static_cast<double>(c.u - a.u));
}

// The boundary of the triangles is the loop, each side once, and nothing folds: so they fill it.
void expect_fills(const Loop& loop, const Triangles& triangles) {
    ASSERT_EQ(triangles.size(), loop.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    double sum = 0;
    for (const auto& t : triangles) {
        EXPECT_EQ(turn(loop[t[0]], loop[t[1]], loop[t[2]]), 1);
        sum += area(loop[t[0]], loop[t[1]], loop[t[2]]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            sides[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    const auto n = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = i + 1 == n ? 0 : i + 1;
        sides[std::minmax(i, j)] -= i < j ? 1 : -1;
    }
    for (const auto& [side, count] : sides) EXPECT_EQ(count, 0) << side.first << " " << side.second;
    double expected = 0;
    for (std::uint32_t i = 1; i + 1 < n; ++i) expected += area(loop[0], loop[i], loop[i + 1]);
    EXPECT_NEAR(sum, expected, 1e-9 * std::abs(expected));
}

// `most`: comparisons for each corner.
void cut(const Loop& loop, std::uint64_t most) {
    ShortEars ears;
    Triangles triangles{{7, 7, 7}};
    ASSERT_TRUE(ears.triangulate(loop, triangles));
    EXPECT_LE(ears.comparisons(), most * loop.size());
    ASSERT_EQ(triangles.front(), (std::array<std::uint32_t, 3>{7, 7, 7}));
    triangles.erase(triangles.begin());
    expect_fills(loop, triangles);
}

TEST(ShortEars, StarsOfManyCorners) {
    for (const std::uint32_t corners : {64U, 250U, 2'000U, 20'000U})
        cut(star(corners), 60 + static_cast<std::uint64_t>(std::sqrt(corners)));
}

TEST(ShortEars, StarsHaveNoCornerWithManyTriangles) {
    const Loop loop = star(4'096);
    ShortEars ears;
    Triangles triangles;
    ASSERT_TRUE(ears.triangulate(loop, triangles));
    std::vector<int> at(loop.size());
    int most = 0;
    for (const auto& t : triangles)
        for (const std::uint32_t c : t) most = std::max(most, ++at[c]);
    EXPECT_LE(most, 40);
}

TEST(ShortEars, CombsAndSpirals) {
    cut(comb(1'000, 20), 1'000);
    cut(comb(1'000, 1'000'000), 1'000);
    cut(spiral(4'000), 60);
}

TEST(ShortEars, RandomRadii) {
    std::mt19937_64 random(5);
    for (int round = 0; round < 20; ++round) {
        std::uniform_real_distribution<double> radius(0x1p30, 0x1p36);
        cut(star_shaped(500, [&](std::uint32_t) { return radius(random); }), 60);
    }
}

TEST(ShortEars, StraightRuns) {
    Loop loop;
    for (std::int64_t i = 0; i < 100; ++i) loop.push_back({i, 0});
    for (std::int64_t i = 0; i < 100; ++i) loop.push_back({100, i});
    for (std::int64_t i = 100; i > 50; --i) loop.push_back({i, 100});
    for (std::int64_t i = 100; i > 50; --i) loop.push_back({50, i});
    for (std::int64_t i = 50; i > 0; --i) loop.push_back({i, 50});
    for (std::int64_t i = 50; i > 0; --i) loop.push_back({0, i});
    cut(loop, 60);
}

TEST(ShortEars, LoopsTheOtherWayRoundAreLeft) {
    Loop loop = star(100);
    std::reverse(loop.begin(), loop.end());
    ShortEars ears;
    Triangles triangles;
    EXPECT_FALSE(ears.triangulate(loop, triangles));
    EXPECT_TRUE(triangles.empty());
}

}  // namespace
