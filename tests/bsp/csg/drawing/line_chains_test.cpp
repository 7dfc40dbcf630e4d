// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/line_chains.h>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

std::vector<Outline> chains_of(const std::vector<std::pair<Point2d, Point2d>>& lines) {
    LineChains chains;
    for (const auto& [a, b] : lines) chains.add(a, b);
    return chains.outlines();
}

TEST(LineChains, LinesOfEitherDirectionBecomeOneOutline) {
    const auto out = chains_of({{{0, 0}, {4, 0}}, {{4, 3}, {4, 0}}, {{4, 3}, {0, 0}}});
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0], (Outline{{0, 0}, {4, 0}, {4, 3}, {0, 0}}));
}

TEST(LineChains, AnOpenChainBeginsAtItsFreeEnd) {
    const auto out = chains_of({{{4, 0}, {4, 3}}, {{0, 0}, {4, 0}}});
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0], (Outline{{4, 3}, {4, 0}, {0, 0}}));
}

TEST(LineChains, EndsInNeighbouringCellsMeet) {
    const auto out = chains_of({{{0, 0}, {4, 0}}, {{4.0005, 0.0005}, {4, 3}}, {{4, 3}, {0, 0}}});
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0][1], (Point2d{4, 0}));
    EXPECT_EQ(out[0].size(), 4U);
}

TEST(LineChains, LinesOfNoLengthAreLeftOut) {
    EXPECT_TRUE(chains_of({{{1, 1}, {1, 1}}, {{1, 1}, {1.0001, 1}}}).empty());
}

TEST(LineChains, ABranchGoesOnWithTheLineThatWasFirst) {
    const auto out = chains_of({{{0, 0}, {1, 0}},
                                {{1, 0}, {0, 1}},
                                {{0, 1}, {0, 0}},
                                {{0, 0}, {-1, 0}},
                                {{-1, 0}, {0, -1}},
                                {{0, -1}, {0, 0}}});
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0].size(), 7U);
    EXPECT_EQ(out[0][1], (Point2d{1, 0}));
}

// Each line in one outline, and in linear time where all share a point.
TEST(LineChains, AStarOfManyLines) {
    LineChains chains;
    constexpr int n = 20'000;
    for (int i = 1; i <= n; ++i) chains.add({0, 0}, {i * 1.0, 7.0 * i});
    std::size_t lines = 0;
    for (const Outline& outline : chains.outlines()) lines += outline.size() - 1;
    EXPECT_EQ(lines, static_cast<std::size_t>(n));
}

}  // namespace
}  // namespace trisect::detail
