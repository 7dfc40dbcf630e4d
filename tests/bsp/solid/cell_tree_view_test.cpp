// SPDX-License-Identifier: Apache-2.0
//
// The cells of a slice must tile it, and what a homogeneous cell says must be true.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/cell_tree_view.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::cell_tree_leaves;
using trisect::cell_tree_stats;
using trisect::CellLeaf;
using trisect::CellTreeStats;
using trisect::evaluate;
using trisect::Solid;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> nowhere_below{-infinity, -infinity, -infinity};
constexpr std::array<double, 3> nowhere_above{infinity, infinity, infinity};

bool contains(const CellLeaf& leaf, const std::array<double, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] <= leaf.lo[k] || p[k] >= leaf.hi[k]) return false;
    }
    return true;
}

// Two unit balls whose centres are 1 apart in x; the second one is taken away.
class DifferenceOfBalls : public ::testing::Test {
protected:
    const Solid solid =
        evaluate(Solid::from_mesh(trisect::make_icosphere(1, 4)) -
                 Solid::from_mesh(trisect::transformed(
                     trisect::make_icosphere(1, 4), trisect::AffineMap::translation({1, 0, 0}))));
    const std::vector<CellLeaf> all = cell_tree_leaves(solid, nowhere_below, nowhere_above);
};

TEST_F(DifferenceOfBalls, StatisticsCountWhatTheLeavesSay) {
    const CellTreeStats stats = cell_tree_stats(solid);
    ASSERT_EQ(stats.leaves, all.size());
    EXPECT_EQ(stats.nodes, 2 * stats.leaves - 1);
    EXPECT_EQ(stats.leaves, stats.inside_leaves + stats.outside_leaves + stats.listing_leaves);
    CellTreeStats sums;
    for (const CellLeaf& leaf : all) {
        sums.polygons += leaf.polygons;
        sums.depth = std::max(sums.depth, leaf.depth);
        sums.largest_leaf = std::max(sums.largest_leaf, leaf.polygons);
        sums.inside_leaves += leaf.is_inside ? 1 : 0;
        sums.arranged_leaves += leaf.is_arranged ? 1 : 0;
    }
    EXPECT_EQ(stats.polygons, sums.polygons);
    EXPECT_EQ(stats.depth, sums.depth);
    EXPECT_EQ(stats.largest_leaf, sums.largest_leaf);
    EXPECT_EQ(stats.inside_leaves, sums.inside_leaves);
    EXPECT_EQ(stats.arranged_leaves, sums.arranged_leaves);
    EXPECT_GT(stats.arranged_leaves, 0U);
    EXPECT_GT(stats.fragments, 0U);
    EXPECT_GT(stats.bytes, stats.nodes * 32);
}

TEST_F(DifferenceOfBalls, EveryPointIsInOneCell) {
    for (double x = -1.93; x < 3; x += 0.31) {
        for (double y = -1.51; y < 2; y += 0.37) {
            int cells = 0;
            for (const CellLeaf& leaf : all) cells += contains(leaf, {x, y, 0.123}) ? 1 : 0;
            EXPECT_EQ(cells, 1) << x << ' ' << y;
        }
    }
}

TEST_F(DifferenceOfBalls, HomogeneousCellsTellTheTruth) {
    std::size_t checked = 0;
    for (const CellLeaf& leaf : all) {
        if (leaf.polygons != 0) continue;
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = std::clamp(leaf.lo[k] / 2 + leaf.hi[k] / 2, -9.0, 9.0);
            if (std::isinf(leaf.lo[k]) && std::isinf(leaf.hi[k])) p[k] = 0;
        }
        if (!contains(leaf, p)) continue;
        const double from_first = std::hypot(p[0], p[1], p[2]);
        const double from_second = std::hypot(p[0] - 1, p[1], p[2]);
        // The balls are polyhedra, a little smaller than balls.
        if (std::abs(from_first - 1) < 0.02 || std::abs(from_second - 1) < 0.02) continue;
        EXPECT_EQ(leaf.is_inside, from_first < 1 && from_second > 1);
        ++checked;
    }
    EXPECT_GT(checked, 0U);
}

TEST_F(DifferenceOfBalls, SliceHasTheCellsThatReachIntoIt) {
    for (const double z : {-0.75, 0.0, 0.123, 0.5, 2.0}) {
        std::size_t expected = 0;
        for (const CellLeaf& leaf : all) {
            expected += leaf.lo[2] <= z && z <= leaf.hi[2] ? 1 : 0;
        }
        const auto slice =
            cell_tree_leaves(solid, {-infinity, -infinity, z}, {infinity, infinity, z});
        EXPECT_EQ(slice.size(), expected) << z;
        EXPECT_LT(slice.size(), all.size());
    }
}

TEST(CellTreeView, ImportIsOneLeafThatListsEverything) {
    const Solid box = Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1}));
    const CellTreeStats stats = cell_tree_stats(box);
    EXPECT_EQ(stats.nodes, 1U);
    EXPECT_EQ(stats.listing_leaves, 1U);
    EXPECT_EQ(stats.polygons, 12U);
    EXPECT_EQ(stats.fragments, 0U);
    const auto leaves = cell_tree_leaves(box, {5, 5, 5}, {5, 5, 5});
    ASSERT_EQ(leaves.size(), 1U);
    EXPECT_EQ(leaves[0].lo[0], -infinity);
    EXPECT_EQ(leaves[0].hi[2], infinity);
}

TEST(CellTreeView, EmptySetAndWholeSpaceAreOneHomogeneousLeaf) {
    EXPECT_EQ(cell_tree_stats(Solid()).outside_leaves, 1U);
    EXPECT_EQ(cell_tree_stats(Solid::whole_space()).inside_leaves, 1U);
    EXPECT_FALSE(cell_tree_leaves(Solid(), nowhere_below, nowhere_above)[0].is_inside);
    EXPECT_TRUE(cell_tree_leaves(Solid::whole_space(), nowhere_below, nowhere_above)[0].is_inside);
}

TEST(CellTreeView, ComplementTurnsInsideAround) {
    const Solid box = Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1}));
    const Solid other = Solid::from_mesh(trisect::make_box({5, 0, 0}, {6, 1, 1}));
    const CellTreeStats both = cell_tree_stats(evaluate(box | other));
    const CellTreeStats neither = cell_tree_stats(evaluate(~(box | other)));
    EXPECT_EQ(both.inside_leaves, neither.outside_leaves);
    EXPECT_EQ(both.outside_leaves, neither.inside_leaves);
}

TEST(CellTreeView, BoxesWithoutOrderAreRefused) {
    const Solid box = Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1}));
    EXPECT_THROW((void)cell_tree_leaves(box, {1, 0, 0}, {0, 1, 1}), trisect::UsageError);
    EXPECT_THROW((void)cell_tree_leaves(box, {NAN, 0, 0}, {0, 1, 1}), trisect::UsageError);
}

// Down the nodes to the leaf of a point; positions are whole numbers, so sides are exact.
std::size_t leaf_of(const std::vector<trisect::CellTreeNode>& nodes, const std::array<double, 3>& p,
                    int exponent) {
    std::size_t i = 0;
    while (nodes[i].axis >= 0) {
        const double x = p[static_cast<std::size_t>(nodes[i].axis)];
        const double fine = std::ldexp(x, -exponent) * trisect::cell_position_scale;
        i = fine < static_cast<double>(nodes[i].position) ? i + 1 : nodes[i].above;
    }
    return i;
}

TEST_F(DifferenceOfBalls, NodesLeadPointsToTheLeavesOfTheList) {
    const std::vector<trisect::CellTreeNode> nodes = trisect::cell_tree_nodes(solid);
    ASSERT_EQ(nodes.size(), cell_tree_stats(solid).nodes);
    std::vector<const trisect::CellTreeNode*> leaves;
    for (const trisect::CellTreeNode& n : nodes)
        if (n.axis < 0) leaves.push_back(&n);
    ASSERT_EQ(leaves.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(leaves[i]->polygons, all[i].polygons);
        EXPECT_EQ(leaves[i]->is_inside, all[i].is_inside);
        EXPECT_EQ(leaves[i]->is_arranged, all[i].is_arranged);
    }
    for (int x = -4; x <= 4; ++x)
        for (int y = -4; y <= 4; ++y) {
            const std::array<double, 3> p{x / 3.7, y / 3.7, 0.3};
            const trisect::CellTreeNode& leaf = nodes[leaf_of(nodes, p, solid.lattice().exponent)];
            const auto found = cell_tree_leaves(solid, p, p);
            ASSERT_EQ(found.size(), 1U);
            EXPECT_EQ(leaf.polygons, found[0].polygons);
            EXPECT_EQ(leaf.is_inside, found[0].is_inside);
        }
}

TEST(CellTreeNodes, OfAnUntouchedMeshAreOneLeaf) {
    const auto nodes = trisect::cell_tree_nodes(Solid::from_mesh(trisect::make_icosphere(1, 1)));
    ASSERT_EQ(nodes.size(), 1U);
    EXPECT_EQ(nodes[0].axis, -1);
    EXPECT_EQ(nodes[0].polygons, 80U);
}

}  // namespace
