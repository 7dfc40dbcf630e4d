// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import/thin_triangles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace trisect {
namespace {

using detail::TrianglesWithoutThin;
using detail::without_thin_triangles;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double width = 0x1p-40;

// Whether each edge is passed as often in one direction as in the other.
bool is_closed(const Triangles& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            ++edges[{t[i], t[(i + 1) % 3]}];
            --edges[{t[(i + 1) % 3], t[i]}];
        }
    return std::ranges::all_of(edges, [](const auto& e) { return e.second == 0; });
}

// A tetrahedron whose base has a further point beside its edge from 1 to 2.
const std::vector<Point3d> capped{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, 2, 0x1p-50}};
const Triangles cap{{0, 2, 1}, {2, 4, 1}, {0, 1, 3}, {0, 3, 2}, {1, 4, 3}, {4, 2, 3}};

TEST(ThinTriangles, ACapGivesItsLongestEdgeUp) {
    const TrianglesWithoutThin out = without_thin_triangles(capped, cap, width);
    EXPECT_EQ(out.triangles.size(), 6U);
    EXPECT_TRUE(is_closed(out.triangles));
    const auto has_edge = [&](std::uint32_t a, std::uint32_t b) {
        return std::ranges::any_of(out.triangles, [&](const auto& t) {
            return std::ranges::count(t, a) + std::ranges::count(t, b) == 2;
        });
    };
    EXPECT_FALSE(has_edge(1, 2));
    EXPECT_TRUE(has_edge(0, 4));
    // Both new triangles are parts of the base.
    EXPECT_EQ(std::ranges::count(out.origin, 0U), 2);
    EXPECT_EQ(std::ranges::count(out.origin, 1U), 0);
    for (std::uint32_t p = 0; p < 5; ++p) EXPECT_EQ(out.point[p], p);
}

TEST(ThinTriangles, WhatIsThickStays) {
    std::vector<Point3d> points = capped;
    points[4] = {2, 2, 0x1p-30};
    const TrianglesWithoutThin out = without_thin_triangles(points, cap, width);
    EXPECT_EQ(out.triangles, cap);
    EXPECT_EQ(out.origin, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(ThinTriangles, EndsOfAShortEdgeBecomeOne) {
    std::vector<Point3d> points = capped;
    points[4] = {4, 0x1p-50, 0};  // beside the first one
    const TrianglesWithoutThin out = without_thin_triangles(points, cap, width);
    EXPECT_EQ(out.point[4], 1U);
    EXPECT_EQ(out.triangles.size(), 4U);
    EXPECT_TRUE(is_closed(out.triangles));
}

// A row of points beside one line, of which the thin triangles between them make a strip.
TEST(ThinTriangles, ManyPointsBesideOneEdge) {
    std::vector<Point3d> points{{0, 0, 0}, {16, 0, 0}, {8, 16, 0}, {8, 8, 8}};
    Triangles triangles{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
    // The edge from 0 to 1 of the last is divided, and strips lie between it and the first.
    triangles.erase(triangles.begin());
    std::uint32_t last = 0;
    for (std::uint32_t i = 1; i < 16; ++i) {
        points.push_back({static_cast<double>(i), i % 2 == 0 ? 0x1p-51 : -0x1p-50, 0x1p-52});
        const auto p = static_cast<std::uint32_t>(points.size() - 1);
        triangles.push_back({last, p, 3});
        triangles.push_back({1, p, last});
        last = p;
    }
    triangles.push_back({last, 1, 3});
    ASSERT_TRUE(is_closed(triangles));
    const TrianglesWithoutThin out = without_thin_triangles(points, triangles, width);
    EXPECT_TRUE(is_closed(out.triangles));
    EXPECT_EQ(out.triangles.size(), triangles.size());
    // All strips are gone: each triangle has one of the two far corners.
    for (const auto& t : out.triangles)
        EXPECT_TRUE(std::ranges::count(t, 2U) + std::ranges::count(t, 3U) > 0);
}

// Tori of few triangles whose corners are on a grid of four numbers, almost.
TEST(ThinTriangles, WhatIsClosedStaysClosed) {
    std::mt19937 random(20261129);
    std::size_t changed = 0;
    for (int round = 0; round < 400; ++round) {
        const auto across = static_cast<std::uint32_t>(3 + random() % 6);
        const auto around = static_cast<std::uint32_t>(3 + random() % 6);
        const auto number = [&](std::uint32_t i, std::uint32_t j) {
            return i % across * around + j % around;
        };
        const auto near = [&](double by) {
            return static_cast<double>(random() % 4) + static_cast<double>(random() % 3) * by;
        };
        std::vector<Point3d> points(std::size_t{across} * around);
        for (Point3d& p : points) p = {near(0), near(0x1p-50), near(0x1p-51)};
        Triangles torus;
        for (std::uint32_t i = 0; i < across; ++i)
            for (std::uint32_t j = 0; j < around; ++j) {
                torus.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
                torus.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
            }
        const TrianglesWithoutThin out = without_thin_triangles(points, torus, 0x1p-45);
        EXPECT_TRUE(is_closed(out.triangles));
        for (const auto& t : out.triangles)
            for (const std::uint32_t p : t) EXPECT_EQ(out.point[p], p);
        for (const std::uint32_t t : out.origin) EXPECT_LT(t, torus.size());
        changed += out.triangles != torus ? 1 : 0;
    }
    EXPECT_GT(changed, 200U);
    EXPECT_TRUE(without_thin_triangles({}, {}, 1).triangles.empty());
}

}  // namespace
}  // namespace trisect
