// SPDX-License-Identifier: Apache-2.0
//
// Vertices of a narrow box along an axis, found in columns (vertex_columns.h).

#include <trisect/bsp/assembly/parts/vertex_columns.h>

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vertices_in_box.h"

namespace {

using trisect::detail::VertexColumns;
using Point = vertices_in_box::Point;

class VertexColumnsAlong : public testing::TestWithParam<std::size_t> {};

// Boxes that end where columns and vertices do, one to three columns wide.
TEST_P(VertexColumnsAlong, FindsAllVerticesOfABox) {
    const std::size_t axis = GetParam();
    std::mt19937 random(7);
    const auto at = [&] { return static_cast<double>(random() % 13) - 2; };
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
        const auto vertices = vertices_in_box::random_vertices(at);
        VertexColumns columns;
        EXPECT_TRUE(columns.is_empty());
        columns.build(vertices, axis, 1 + static_cast<double>(round % 3));
        Point lo{at(), at(), at()};
        Point hi = lo;
        for (std::size_t k = 0; k < 3; ++k) hi[k] += static_cast<double>(random() % 5) / 2;
        hi[axis] = at();
        if (lo[axis] > hi[axis]) std::swap(lo[axis], hi[axis]);
        if (!vertices_in_box::expect_all_found(columns, vertices, lo, hi)) ++refused;
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
