// SPDX-License-Identifier: Apache-2.0
//
// Edges of regions in the order of their loops, also of regions with many.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include <trisect/bsp/assembly/parts/edge_chains.h>

namespace {

using trisect::detail::BoundaryEdge;
using trisect::detail::BoundaryEdges;
using trisect::detail::EdgeChains;
using trisect::detail::PointId;

/// A loop through the points [first, first + count).
void add_loop(BoundaryEdges& edges, PointId first, PointId count) {
    for (PointId i = 0; i < count; ++i)
        edges.push_back({first + i, first + (i + 1) % count, 0, {first + i, false}});
}

BoundaryEdges shuffled(BoundaryEdges edges, unsigned seed) {
    std::mt19937 random(seed);
    std::ranges::shuffle(edges, random);
    return edges;
}

std::vector<PointId> lines_of(const BoundaryEdges& edges) {
    std::vector<PointId> out;
    for (const BoundaryEdge& e : edges) out.push_back(e.line.plane);
    return out;
}

TEST(EdgeChains, LoopsOfManyEdgesComeInOrder) {
    EdgeChains chains;
    for (unsigned seed = 0; seed < 20; ++seed) {
        BoundaryEdges edges;
        add_loop(edges, 500, 100);
        for (PointId i = 0; i < static_cast<PointId>(seed); ++i) add_loop(edges, 10 * i, 3 + i % 5);
        const BoundaryEdges given = shuffled(edges, seed);
        BoundaryEdges arranged = given;
        chains.arrange(arranged);
        EXPECT_TRUE(chains.are_simple(arranged));
        EXPECT_EQ(arranged.front().line.plane, given.front().line.plane);
        std::vector<PointId> lines = lines_of(arranged);
        std::vector<PointId> all = lines_of(given);
        std::ranges::sort(lines);
        std::ranges::sort(all);
        EXPECT_EQ(lines, all);
        const std::vector<PointId> once = lines_of(arranged);
        chains.arrange(arranged);
        EXPECT_EQ(lines_of(arranged), once);
    }
}

TEST(EdgeChains, FewEdgesComeInOrder) {
    EdgeChains chains;
    BoundaryEdges edges;
    add_loop(edges, 0, 12);
    add_loop(edges, 20, 5);
    edges = shuffled(edges, 1);
    chains.arrange(edges);
    EXPECT_TRUE(chains.are_simple(edges));
}

// A vertex that is passed twice: turns say which edge continues another.
TEST(EdgeChains, ManyEdgesThatTouchStayAsTheyAre) {
    EdgeChains chains;
    BoundaryEdges edges;
    add_loop(edges, 0, 40);
    add_loop(edges, 39, 40);
    edges = shuffled(edges, 2);
    const std::vector<PointId> before = lines_of(edges);
    chains.arrange(edges);
    EXPECT_EQ(lines_of(edges), before);
    EXPECT_FALSE(chains.are_simple(edges));
}

TEST(EdgeChains, ManyEdgesThatDoNotCloseStayAsTheyAre) {
    EdgeChains chains;
    BoundaryEdges edges;
    add_loop(edges, 0, 60);
    edges = shuffled(edges, 3);
    edges.pop_back();
    const std::vector<PointId> before = lines_of(edges);
    chains.arrange(edges);
    EXPECT_EQ(lines_of(edges), before);
}

}  // namespace
