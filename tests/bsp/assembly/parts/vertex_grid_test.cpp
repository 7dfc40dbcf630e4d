// SPDX-License-Identifier: Apache-2.0
//
// Vertices of a box, found in a grid (vertex_grid.h).

#include <trisect/bsp/assembly/parts/vertex_grid.h>

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vertices_in_box.h"

namespace {

using trisect::detail::VertexGrid;
using Point = vertices_in_box::Point;

// The size of a lattice: solids may be far smaller or larger than its unit.
class VertexGridOfSize : public testing::TestWithParam<double> {};

// Points on sides of cubes, in boxes that end there, and beyond all of them.
TEST_P(VertexGridOfSize, FindsAllVerticesOfABox) {
    std::mt19937 random(5);
    const auto at = [&] { return GetParam() * (static_cast<double>(random() % 13) - 2); };
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
        const auto vertices = vertices_in_box::random_vertices(at);
        VertexGrid grid;
        grid.build(vertices, GetParam() * static_cast<double>(round % 5) / 2);
        Point lo{at(), at(), at()};
        Point hi{at(), at(), at()};
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] > hi[k]) std::swap(lo[k], hi[k]);
        if (!vertices_in_box::expect_all_found(grid, vertices, lo, hi)) ++refused;
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 200);
}

INSTANTIATE_TEST_SUITE_P(Sizes, VertexGridOfSize, testing::Values(1, 0x1p-70, 0x1p58));

TEST(VertexGrid, OfOnePoint) {
    const std::vector<VertexGrid::Vertex> vertices{{{3, 4, 5}, 0}, {{3, 4, 5}, 1}};
    VertexGrid grid;
    grid.build(vertices, 0);
    std::size_t seen = 0;
    EXPECT_TRUE(
        grid.for_each_near({0, 0, 0}, {9, 9, 9}, [&](const auto& part) { seen += part.size(); }));
    EXPECT_EQ(seen, 2U);
}

}  // namespace
