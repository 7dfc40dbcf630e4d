// SPDX-License-Identifier: Apache-2.0
//
// Trees as deep as they have nodes, on a thread with a small stack.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/bsp/msp_tree.h>

#include "support/lattice_arithmetic.h"
#include "support/small_stack.h"

namespace trisect {
namespace {

using Leaf = MspTree::Leaf;

/// A prism over a polygon with 2n + 1 corners on a parabola: convex, all faces different. Vertex i
/// of the bottom is (i - n, (i - n)², 0); the caps are the first two faces.
Brep parabolic_prism(std::int64_t n, std::int64_t height) {
    BrepBuilder builder{Lattice{}};
    const auto count = static_cast<std::uint32_t>(2 * n + 1);
    for (const std::int64_t z : {std::int64_t{0}, height})
        for (std::int64_t x = -n; x <= n; ++x) builder.add_vertex(LatticePoint{x, x * x, z});
    std::vector<std::uint32_t> bottom;
    std::vector<std::uint32_t> top;
    for (std::uint32_t i = 0; i < count; ++i) {
        bottom.push_back(count - 1 - i);
        top.push_back(count + i);
    }
    builder.add_polygon(Plane::axis_aligned(2, 1, 0).flipped(), bottom, {});
    builder.add_polygon(Plane::axis_aligned(2, 1, height), top, {});
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count;
        const auto at = [n](std::uint32_t k) {
            const std::int64_t x = static_cast<std::int64_t>(k) - n;
            return LatticePoint{x, x * x, 0};
        };
        const std::vector<std::uint32_t> wall{i, j, count + j, count + i};
        builder.add_polygon(Plane::through(at(i), at(j), at(j) + LatticePoint{0, 0, height}), wall,
                            {});
    }
    return std::move(builder).build();
}

TEST(MspDeep, ChainOfAHundredThousandFaces) {
    const Brep brep = parabolic_prism(50000, 10);
    EXPECT_EQ(
        test::run_with_small_stack([&brep] {
            MspOptions options;
            options.split_heuristic = MspHeuristic::AsGiven;
            const MspTree tree = MspTree::from_brep(brep, options);
            const MspStats stats = tree.stats();
            EXPECT_EQ(stats.faces, 100003U);
            EXPECT_EQ(stats.space_depth, 100003U);
            EXPECT_EQ(stats.fragments, stats.polygons);
            EXPECT_EQ(tree.locate(LatticePoint{0, 1, 5}).kind(), Leaf::In);
            EXPECT_EQ(tree.locate(LatticePoint{17, 289, 5}).kind(), Leaf::OnEdge);
            EXPECT_EQ(tree.locate(LatticePoint{17, 289, 10}).kind(), Leaf::OnVertex);
            EXPECT_EQ(tree.locate(LatticePoint{17, 290, 10}).kind(), Leaf::OnFace);
            EXPECT_EQ(tree.locate(LatticePoint{17, 288, 10}).kind(), Leaf::Out);
            EXPECT_EQ(tree.locate(LatticePoint{49999, 49999LL * 49999, 0}).kind(), Leaf::OnVertex);
        }),
        "");
}

TEST(MspDeep, ValidatedChain) {
    const Brep brep = parabolic_prism(200, 10);
    EXPECT_EQ(test::run_with_small_stack(
                  [&brep] { EXPECT_NO_THROW(MspTree::from_brep(brep).validate(brep)); }),
              "");
}

}  // namespace
}  // namespace trisect
