// SPDX-License-Identifier: Apache-2.0
//
// Vertices near an edge, found in a tree of boxes (vertex_boxes.h).

#include <trisect/bsp/assembly/parts/vertex_boxes.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::VertexBoxes;
using Point = std::array<double, 3>;

// The size of a grid: solids may be far smaller or larger than the unit of their lattice.
class VertexBoxesOfSize : public testing::TestWithParam<double> {};

// Points of a small grid, so that many lie on the edge.
TEST_P(VertexBoxesOfSize, FindAllVerticesOnAnEdgeAndFewOthers) {
    std::mt19937 random(3);
    const auto at = [&] { return GetParam() * static_cast<double>(random() % 9); };
    std::size_t seen = 0;
    std::size_t tried = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<VertexBoxes::Vertex> vertices;
        for (int i = 0; i < 700; ++i) vertices.push_back({{at(), at(), at()}, i});
        VertexBoxes boxes;
        boxes.build(vertices);
        const Point from{at(), at(), at()};
        const Point to{at(), at(), at()};
        std::vector<bool> found(vertices.size());
        boxes.for_each_near(from, to, 1e-9 * GetParam(),
                            [&](std::span<const VertexBoxes::Vertex> part) {
                                for (const auto& v : part)
                                    found[static_cast<std::size_t>(v.point)] = true;
                                seen += part.size();
                            });
        tried += vertices.size();
        for (const auto& v : vertices) {
            double cross = 0;
            double along = 0;
            double length = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = (k + 1) % 3;
                const std::size_t j = (k + 2) % 3;
                cross += std::fabs((v.c[i] - from[i]) * (to[j] - from[j]) -
                                   (v.c[j] - from[j]) * (to[i] - from[i]));
                along += (v.c[k] - from[k]) * (to[k] - from[k]);
                length += (to[k] - from[k]) * (to[k] - from[k]);
            }
            const bool is_point = length == 0;
            const bool on = is_point ? v.c == from : cross == 0 && along >= 0 && along <= length;
            if (on) {
                EXPECT_TRUE(found[static_cast<std::size_t>(v.point)]);
            }
        }
    }
    EXPECT_LT(seen, tried / 5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, VertexBoxesOfSize, testing::Values(1, 0x1p-70, 0x1p58));

// Many vertices are parted by several threads: in the same way.
TEST(VertexBoxes, AreTheSameOnThreads) {
    std::mt19937 random(5);
    const auto at = [&] { return static_cast<double>(random() % 1000); };
    std::vector<VertexBoxes::Vertex> alone;
    for (int i = 0; i < 20000; ++i) alone.push_back({{at(), at(), i % 3 == 0 ? 7 : at()}, i});
    std::vector<VertexBoxes::Vertex> shared = alone;
    VertexBoxes by_one;
    VertexBoxes by_many;
    by_one.build(alone);
    by_many.build(shared, 4);
    for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(alone[i].point, shared[i].point);
    for (int i = 0; i < 100; ++i) {
        const Point from{at(), at(), at()};
        const Point to{at(), at(), at()};
        const auto found = [&](const VertexBoxes& boxes) {
            std::vector<int> out;
            boxes.for_each_near(from, to, 0.5, [&](std::span<const VertexBoxes::Vertex> part) {
                for (const auto& v : part) out.push_back(v.point);
            });
            return out;
        };
        EXPECT_EQ(found(by_many), found(by_one));
    }
}

// Rings of many vertices in planes far from the origin: an edge from one to the next one meets few
// others.
TEST(VertexBoxes, OfPlanesStayTogether) {
    constexpr int around = 1000;
    constexpr double far_out = 0x1p30;
    std::vector<VertexBoxes::Vertex> vertices;
    for (int i = 0; i < 3 * around; ++i) {
        const double angle = 2 * std::numbers::pi * (i % around) / around;
        vertices.push_back({{far_out + std::cos(angle), std::sin(angle) - far_out,
                             static_cast<double>(i / around)},
                            i});
    }
    const std::vector<VertexBoxes::Vertex> all = vertices;
    VertexBoxes boxes;
    boxes.build(vertices);
    std::size_t seen = 0;
    for (int i = 0; i + 1 < around; ++i) {
        const auto from = static_cast<std::size_t>(i);
        const std::size_t to = from + around;
        std::size_t ends = 0;
        const auto look_at = [&](std::span<const VertexBoxes::Vertex> part) {
            seen += part.size();
            for (const auto& v : part)
                ends += v.point == all[from].point || v.point == all[to].point ? 1U : 0U;
        };
        boxes.for_each_near(all[from].c, all[to].c, 1e-6, look_at);
        EXPECT_EQ(ends, 2U);
    }
    EXPECT_LT(seen, 40U * around);
}

}  // namespace
