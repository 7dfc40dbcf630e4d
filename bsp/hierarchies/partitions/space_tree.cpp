// SPDX-License-Identifier: Apache-2.0
//
// Dividing until every list is short need not end: where many triangles share a corner, some cell
// always has them all, and large triangles are listed over and over. A division has to make all
// lists shorter, and what it adds to the number of entries comes out of a budget. Dividing the
// longest list first spends the budget where it is worth most.

#include <trisect/bsp/hierarchies/partitions/space_tree.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/interference/boxes/box_gap.h>

namespace trisect::hierarchies {

namespace {

struct OpenCell {
    std::uint32_t node = 0;
    unsigned level = 1;
    std::vector<std::uint32_t> list;
};

struct Shorter {
    bool operator()(const OpenCell& a, const OpenCell& b) const {
        return a.list.size() < b.list.size();
    }
};

}  // namespace

SpaceTree::SpaceTree(const TriangleBoxes& boxes, const Box& root, Divide divide, MayMeet may_meet) {
    nodes_.push_back({root});
    std::vector<OpenCell> open(1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) open[0].list.push_back(i);
    std::size_t budget = (most_entries - 1) * boxes.size();
    while (!open.empty()) {
        std::pop_heap(open.begin(), open.end(), Shorter{});
        const OpenCell cell = std::move(open.back());
        open.pop_back();
        depth_ = std::max(depth_, cell.level);
        std::vector<Box> parts;
        if (cell.list.size() > leaf_size && cell.level < most_levels)
            parts = divide(nodes_[cell.node].cell, cell.list);
        std::vector<OpenCell> children(parts.size());
        std::size_t total = 0;
        std::size_t longest = 0;
        for (std::size_t c = 0; c < parts.size(); ++c) {
            for (const std::uint32_t i : cell.list)
                if (boxes[i].meets(parts[c]) && may_meet(i, parts[c]))
                    children[c].list.push_back(i);
            total += children[c].list.size();
            longest = std::max(longest, children[c].list.size());
        }
        const std::size_t growth = total > cell.list.size() ? total - cell.list.size() : 0;
        Node& node = nodes_[cell.node];
        if (parts.empty() || longest >= cell.list.size() || growth > budget) {
            node.first = static_cast<std::uint32_t>(entries_.size());
            node.count = static_cast<std::uint32_t>(cell.list.size());
            entries_.insert(entries_.end(), cell.list.begin(), cell.list.end());
            continue;
        }
        budget -= growth;
        node.is_leaf = false;
        node.first = static_cast<std::uint32_t>(nodes_.size());
        node.count = 0;
        // Empty parts are no cells at all.
        std::vector<Node> added;
        for (std::size_t c = 0; c < parts.size(); ++c) {
            if (children[c].list.empty()) continue;
            children[c].node = node.first + node.count++;
            children[c].level = cell.level + 1;
            added.push_back({parts[c]});
            open.push_back(std::move(children[c]));
            std::push_heap(open.begin(), open.end(), Shorter{});
        }
        nodes_.insert(nodes_.end(), added.begin(), added.end());
    }
}

bool SpaceTree::find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                              CostCounters& counters) {
    stack_.assign(1, 0);
    while (!stack_.empty()) {
        const Node& node = nodes_[stack_.back()];
        stack_.pop_back();
        if (node.is_leaf) {
            for (std::uint32_t e = 0; e < node.count; ++e)
                if (offer(entries_[node.first + e])) return true;
            continue;
        }
        counters.volume_tests += node.count;
        for (std::uint32_t c = node.first; c < node.first + node.count; ++c)
            if (nodes_[c].cell.meets(box)) stack_.push_back(c);
    }
    return false;
}

void SpaceTree::find_near_cells(const Box& box, double limit,
                                FunctionRef<double(std::uint32_t)> offer, CostCounters& counters) {
    std::vector<NearNode>& stack = near_stack_;
    stack.assign(1, {0, 0});
    while (!stack.empty()) {
        const NearNode top = stack.back();
        stack.pop_back();
        if (top.least > limit) continue;
        const Node& node = nodes_[top.node];
        if (node.is_leaf) {
            for (std::uint32_t e = 0; e < node.count; ++e) limit = offer(entries_[node.first + e]);
            continue;
        }
        counters.volume_tests += node.count;
        const std::size_t bottom = stack.size();
        for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
            const double least = gap_between(nodes_[c].cell, box);
            if (!(least > limit)) stack.push_back({least, c});
        }
        std::sort(stack.begin() + static_cast<std::ptrdiff_t>(bottom), stack.end(),
                  [](const NearNode& a, const NearNode& b) { return a.least > b.least; });
    }
}

}  // namespace trisect::hierarchies
