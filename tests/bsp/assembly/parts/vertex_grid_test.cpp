// SPDX-License-Identifier: Apache-2.0
//
// Vertices of a box, found in a grid (vertex_grid.h).

#include <trisect/bsp/assembly/parts/vertex_grid.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::VertexGrid;
using Point = std::array<double, 3>;

// The size of a lattice: solids may be far smaller or larger than its unit.
class VertexGridOfSize : public testing::TestWithParam<double> {};

// Points on sides of cubes, in boxes that end there, and beyond all of them.
TEST_P(VertexGridOfSize, FindsAllVerticesOfABox) {
    std::mt19937 random(5);
    const auto at = [&] { return GetParam() * (static_cast<double>(random() % 13) - 2); };
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<VertexGrid::Vertex> vertices;
        for (int i = 0; i < 400; ++i) vertices.push_back({{at(), at(), at()}, i});
        VertexGrid grid;
        grid.build(vertices, GetParam() * static_cast<double>(round % 5) / 2);
        Point lo{at(), at(), at()};
        Point hi{at(), at(), at()};
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] > hi[k]) std::swap(lo[k], hi[k]);
        std::vector<int> found(vertices.size());
        const bool is_short =
            grid.for_each_near(lo, hi, [&](std::span<const VertexGrid::Vertex> part) {
                for (const auto& v : part) ++found[static_cast<std::size_t>(v.point)];
            });
        if (!is_short) {
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
