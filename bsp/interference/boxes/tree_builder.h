// SPDX-License-Identifier: Apache-2.0
//
// Top-down construction of trees over items with boxes.
// Only the shape of the tree is made here; volumes are put in later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trisect::hierarchies {

/// How a part is divided.
enum class SplitRule : std::uint8_t {
    Median,     ///< as many things on both sides, across the longest extent of their centres
    Mean,       ///< at the mean of the centres, perpendicular to the axis of their largest variance
    Principal,  ///< at the mean of the centres, across their principal axis, whatever way it points
    SurfaceArea  ///< where areas of boxes times numbers are least, of 16 places on each axis
};

struct TreeOptions {
    SplitRule split = SplitRule::SurfaceArea;
    unsigned arity = 2;        ///< children of a node: 2 to 8
    unsigned leaf_things = 1;  ///< at most, but for things that have one centre
};

/// A thing as the builder sees it.
struct TreeItem {
    std::array<double, 3> center{};
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
};

/// Children of a node are next to each other, after it.
struct TreeNode {
    std::uint32_t first = 0;  ///< the first child, or the first thing in `order`
    std::uint16_t count = 0;  ///< how many
    bool leaf = false;
};

/// Node 0 is around everything.
struct TreeShape {
    std::vector<TreeNode> nodes;
    std::vector<std::uint32_t> order;  ///< things as leaves name them
    unsigned depth = 0;                ///< levels

    [[nodiscard]] std::span<const std::uint32_t> things(const TreeNode& leaf) const {
        return std::span(order).subspan(leaf.first, leaf.count);
    }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(TreeNode) + order.size() * sizeof(std::uint32_t);
    }
};

/// Deterministic. O(n log n) as long as splits are not too uneven; a split that leaves less than a
/// 64th on one side is done at the median instead. \pre items is not empty; 1 <= leaf_things <= 255
[[nodiscard]] TreeShape build_tree(std::span<const TreeItem> items, const TreeOptions& options);

}  // namespace trisect::hierarchies
