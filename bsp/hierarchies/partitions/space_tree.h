// SPDX-License-Identifier: Apache-2.0
//
// SpaceTree: a box divided recursively into boxes, with triangle lists.
// The leaves list the triangles that may meet them. Octree and k-d tree share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>
#include <trisect/bsp/interference/boxes/cost.h>
#include <trisect/kernel/support/function_ref.h>

namespace trisect::hierarchies {

/// Cells are closed: what lies on a splitting plane is in the cells on both sides. A triangle is in
/// every leaf that it may meet. The lists of all leaves together have at most `most_entries`
/// entries a triangle, and no way is longer than `most_levels`: the cell with the longest list is
/// divided first, and where the budget ends lists stay long.
///
/// Value type; its queries are for one thread.
class SpaceTree {
public:
    static constexpr std::size_t leaf_size = 8;
    static constexpr std::size_t most_entries = 6;
    static constexpr unsigned most_levels = 24;

    /// The parts of a cell, which fill it; none to leave it whole.
    using Divide =
        FunctionRef<std::vector<Box>(const Box& cell, std::span<const std::uint32_t> list)>;
    /// Whether a triangle may meet a cell that its box meets.
    using MayMeet = FunctionRef<bool(std::uint32_t triangle, const Box& cell)>;

    SpaceTree() = default;
    /// \pre all boxes are within `root`.
    SpaceTree(const TriangleBoxes& boxes, const Box& root, Divide divide, MayMeet may_meet);

    /// See Partition.
    bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                       CostCounters& counters);
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters);

    /// visit(cell, level, is_leaf) for the cells of the first levels, a parent before its children.
    template <class Visit>
    void for_each_cell(unsigned levels, Visit&& visit) const {
        std::vector<std::uint32_t> nodes{0};
        for (unsigned level = 0; level < levels && !nodes.empty(); ++level) {
            std::vector<std::uint32_t> children;
            for (const std::uint32_t n : nodes) {
                const Node& node = nodes_[n];
                visit(node.cell, level, node.is_leaf);
                for (std::uint32_t c = 0; !node.is_leaf && c < node.count; ++c)
                    children.push_back(node.first + c);
            }
            nodes = std::move(children);
        }
    }

    [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
    [[nodiscard]] std::size_t entry_count() const { return entries_.size(); }
    [[nodiscard]] unsigned depth() const { return depth_; }
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.size() * sizeof(Node) + entries_.size() * sizeof(entries_[0]);
    }

private:
    struct Node {
        Box cell;
        std::uint32_t first = 0;  // child, or entry of a leaf
        std::uint32_t count = 0;
        bool is_leaf = true;
    };

    struct NearNode {
        double least;
        std::uint32_t node;
    };

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint32_t> stack_;  // scratch
    std::vector<NearNode> near_stack_;
    unsigned depth_ = 0;
};

}  // namespace trisect::hierarchies
