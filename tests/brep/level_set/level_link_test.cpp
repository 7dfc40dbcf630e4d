// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_link.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace trisect::detail {
namespace {

using Signs = std::array<std::int8_t, LevelLink::neighbours>;

Signs all(int sign) {
    Signs out{};
    out.fill(static_cast<std::int8_t>(sign));
    return out;
}

TEST(LevelLink, IsAClosedSurfaceOfTriangles) {
    std::set<std::pair<int, int>> edges;
    for (const auto& t : LevelLink::triangles())
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second);
    EXPECT_EQ(edges.size(), 72U);
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
}

TEST(LevelLink, CurvesAroundANode) {
    EXPECT_FALSE(LevelLink::has_one_curve(all(1)));
    EXPECT_FALSE(LevelLink::has_one_curve(all(-1)));
    EXPECT_FALSE(LevelLink::has_one_curve(all(0)));
    for (std::size_t i = 0; i < 14; ++i) {
        Signs one = all(-1);
        one[i] = 1;
        EXPECT_TRUE(LevelLink::has_one_curve(one)) << i;
        one[i] = 0;  // the surface goes nowhere from there
        EXPECT_FALSE(LevelLink::has_one_curve(one)) << i;
    }
    Signs two = all(-1);
    two[8] = two[9] = 1;  // on both sides
    EXPECT_FALSE(LevelLink::has_one_curve(two));
    Signs half = all(-1);  // half of space, its surface through four neighbours
    half[9] = 1;
    for (const int i : {1, 3, 5, 7}) half[static_cast<std::size_t>(i)] = 1;
    for (const int i : {10, 11, 12, 13}) half[static_cast<std::size_t>(i)] = 0;
    EXPECT_TRUE(LevelLink::has_one_curve(half));
}

}  // namespace
}  // namespace trisect::detail
