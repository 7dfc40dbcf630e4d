// SPDX-License-Identifier: Apache-2.0
//
// Vertices of a narrow box along an axis, found in columns (vertex_columns.h).

#include <trisect/bsp/assembly/parts/vertex_columns.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::VertexColumns;
using Point = std::array<double, 3>;

class VertexColumnsAlong : public testing::TestWithParam<std::size_t> {};

// Boxes that end where columns and vertices do, one to three columns wide.
TEST_P(VertexColumnsAlong, FindsAllVerticesOfABox) {
    const std::size_t axis = GetParam();
    std::mt19937 random(7);
    const auto at = [&] { return static_cast<double>(random() % 13) - 2; };
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<VertexColumns::Vertex> vertices;
        for (int i = 0; i < 400; ++i) vertices.push_back({{at(), at(), at()}, i});
        VertexColumns columns;
        EXPECT_TRUE(columns.is_empty());
        columns.build(vertices, axis, 1 + static_cast<double>(round % 3));
        Point lo{at(), at(), at()};
        Point hi = lo;
        for (std::size_t k = 0; k < 3; ++k) hi[k] += static_cast<double>(random() % 5) / 2;
        hi[axis] = at();
        if (lo[axis] > hi[axis]) std::swap(lo[axis], hi[axis]);
        std::vector<int> found(vertices.size());
        const bool is_narrow =
            columns.for_each_near(lo, hi, [&](std::span<const VertexColumns::Vertex> part) {
                for (const auto& v : part) ++found[static_cast<std::size_t>(v.point)];
            });
        if (!is_narrow) {
            ++refused;
            EXPECT_EQ(std::ranges::count(found, 0), 400);
            continue;
        }
        for (const auto& v : vertices) {
            bool is_in = true;
            for (std::size_t k = 0; k < 3; ++k) is_in = is_in && lo[k] <= v.c[k] && v.c[k] <= hi[k];
            const int times = found[static_cast<std::size_t>(v.point)];
            EXPECT_LE(times, 1);
            if (is_in) {
                EXPECT_EQ(times, 1);
            }
        }
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 200);
}

INSTANTIATE_TEST_SUITE_P(Axes, VertexColumnsAlong, testing::Values(0U, 1U, 2U));

// Nothing is looked at that lies beside the box along the axis.
TEST(VertexColumns, OfOneLine) {
    std::vector<VertexColumns::Vertex> vertices;
    for (int i = 0; i < 100; ++i) vertices.push_back({{3, 4, static_cast<double>(99 - i)}, i});
    VertexColumns columns;
    columns.build(vertices, 2, 0x1p-30);
    std::size_t seen = 0;
    EXPECT_TRUE(columns.for_each_near({3, 4, 10}, {3, 4, 14},
                                      [&](const auto& part) { seen += part.size(); }));
    EXPECT_EQ(seen, 5U);
}

}  // namespace
