// SPDX-License-Identifier: Apache-2.0
//
// Trees by every rule over points of a grid, of a line, and in one place: each thing is in one
// leaf, and clusters that lie apart are parted.
#include <trisect/bsp/interference/boxes/tree_builder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/random_solids.h"

namespace {

using trisect::hierarchies::build_tree;
using trisect::hierarchies::SplitRule;
using trisect::hierarchies::TreeItem;
using trisect::hierarchies::TreeNode;
using trisect::hierarchies::TreeOptions;
using trisect::hierarchies::TreeShape;

constexpr SplitRule rules[]{SplitRule::Median, SplitRule::Mean, SplitRule::Principal,
                            SplitRule::SurfaceArea};

TreeItem item(double x, double y, double z) {
    return {{x, y, z}, {x - 0.5, y - 0.5, z - 0.5}, {x + 0.5, y + 0.5, z + 0.5}};
}

// How many things are below a node; what is wrong is reported.
std::size_t count_below(const TreeShape& shape, std::uint32_t at, unsigned level,
                        const TreeOptions& options, unsigned& depth) {
    depth = std::max(depth, level);
    const TreeNode& n = shape.nodes[at];
    if (n.leaf) {
        EXPECT_GE(n.count, 1U);
        EXPECT_LE(n.count, options.leaf_things);
        return n.count;
    }
    EXPECT_GT(n.first, at);
    EXPECT_GE(n.count, 2U);
    EXPECT_LE(n.count, options.arity);
    std::size_t sum = 0;
    for (std::uint32_t i = 0; i < n.count; ++i)
        sum += count_below(shape, n.first + i, level + 1, options, depth);
    return sum;
}

void expect_tree(const std::vector<TreeItem>& items, const TreeOptions& options) {
    const TreeShape shape = build_tree(items, options);
    unsigned depth = 0;
    EXPECT_EQ(count_below(shape, 0, 1, options, depth), items.size());
    EXPECT_EQ(shape.depth, depth);
    std::vector<std::uint32_t> order = shape.order;
    std::ranges::sort(order);
    for (std::uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
    EXPECT_EQ(order.size(), items.size());
    EXPECT_EQ(build_tree(items, options).order, shape.order);
}

TEST(TreeBuilder, EveryThingIsInOneLeaf) {
    reference::Random random(4);
    const auto coordinate = [&random] { return static_cast<double>(random.between(0, 9)); };
    for (const SplitRule rule : rules)
        for (const unsigned arity : {2U, 4U, 8U})
            for (const unsigned leaf_things : {1U, 3U}) {
                const TreeOptions options{rule, arity, leaf_things};
                std::vector<TreeItem> grid;
                std::vector<TreeItem> line;
                for (int i = 0; i < 300; ++i) {
                    grid.push_back(item(coordinate(), coordinate(), coordinate()));
                    line.push_back(item(i * i, 2 * i * i, -i * i));
                }
                expect_tree(grid, options);
                expect_tree(line, options);
                expect_tree(std::vector<TreeItem>(100, item(1, 2, 3)), options);
                expect_tree({item(1, 2, 3)}, options);
            }
}

// Two heaps of unlike size on a slanted line: all rules but the median part them.
TEST(TreeBuilder, HeapsFarApartAreParted) {
    reference::Random random(5);
    for (const SplitRule rule : rules) {
        std::vector<TreeItem> items;
        for (int i = 0; i < 60; ++i) {
            const double at = i < 20 ? 0 : 1000;
            items.push_back(item(at + static_cast<double>(random.between(0, 20)),
                                 2 * at + static_cast<double>(random.between(0, 20)),
                                 -at + static_cast<double>(random.between(0, 20))));
        }
        const TreeShape shape = build_tree(items, {rule, 2, 1});
        const auto first = std::span(shape.order).first(20);
        const bool is_parted = std::ranges::all_of(first, [](std::uint32_t i) { return i < 20; }) ||
                               std::ranges::all_of(std::span(shape.order).last(20),
                                                   [](std::uint32_t i) { return i < 20; });
        EXPECT_EQ(is_parted, true) << static_cast<int>(rule);
        const TreeNode& root = shape.nodes[0];
        unsigned depth = 0;
        const std::size_t below = count_below(shape, root.first, 2, {rule, 2, 1}, depth);
        if (rule == SplitRule::Median)
            EXPECT_EQ(below, 30U);
        else
            EXPECT_TRUE(below == 20 || below == 40) << static_cast<int>(rule);
    }
}

}  // namespace
