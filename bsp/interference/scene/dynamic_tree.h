// SPDX-License-Identifier: Apache-2.0
//
// DynamicTree: a box tree with insertion, removal and motion of items.
// It is repaired where items change.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/boxes/cost.h>
#include <trisect/kernel/support/function_ref.h>

namespace trisect::hierarchies {

/// A binary tree whose leaves are the boxes of slots, and whose inner boxes are exactly as large as
/// they must be. A change costs O(depth): a new leaf goes where the sum of areas grows least
/// (branch and bound), a moved one stays where it is unless its box has left its parent's, and on
/// the way up from any change two grandchildren are exchanged wherever that makes a box smaller
/// (Kopta et al. 2012). So the tree degrades slowly; `quality()` says how far, and `rebuild()`
/// makes it new.
///
/// Hierarchies are often said to need rebuilding when things change. bench/results/hierarchies.md
/// has measurements of that.
class DynamicTree {
public:
    using Box = detail::BodyBox;

    /// \pre no box has this slot.
    void insert(std::uint32_t slot, const Box& box);
    /// \pre a box has this slot, for both.
    void update(std::uint32_t slot, const Box& box);
    void remove(std::uint32_t slot);
    [[nodiscard]] bool contains(std::uint32_t slot) const {
        return slot < leaf_.size() && leaf_[slot] != none;
    }
    [[nodiscard]] std::size_t size() const { return size_; }

    /// All boxes again, by the surface-area heuristic.
    void rebuild();

    /// visit(slot) for the boxes that meet this one. Counts tests.
    void find(const Box& box, FunctionRef<void(std::uint32_t)> visit, CostCounters& counters) const;
    /// All pairs of slots whose boxes meet, in ascending order.
    void pairs(std::vector<detail::BodyPair>& out, CostCounters& counters) const;

    /// The sum of the areas of all inner boxes over the area of the largest: about how many inner
    /// boxes a random plane or ray through the whole meets. Less is better.
    [[nodiscard]] double quality() const;
    /// Boxes written since the beginning: Nu.
    [[nodiscard]] std::uint64_t updates() const { return updates_; }
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.size() * sizeof(Node) + (free_.size() + leaf_.size()) * sizeof(leaf_[0]);
    }
    [[nodiscard]] unsigned depth() const;
    /// Whether links go both ways and every inner box is the box of its children; for tests.
    [[nodiscard]] bool is_sound() const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Node {
        Box box;
        std::uint32_t parent = none;
        std::uint32_t child[2] = {none, none};
        std::uint32_t slot = none;  ///< of a leaf
        [[nodiscard]] bool is_leaf() const { return slot != none; }
    };

    [[nodiscard]] std::uint32_t new_node();
    [[nodiscard]] std::uint32_t best_sibling(const Box& box) const;
    void put_leaf(std::uint32_t leaf);
    void take_leaf(std::uint32_t leaf);
    void repair_from(std::uint32_t node);
    void rotate(std::uint32_t node);
    void exchange(std::uint32_t upper, std::uint32_t lower);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> leaf_;  ///< of each slot
    std::uint32_t root_ = none;
    std::size_t size_ = 0;
    std::uint64_t updates_ = 0;
};

/// The same as a broad phase: nothing is packed anew, moved boxes are repaired one by one.
[[nodiscard]] std::unique_ptr<detail::BroadPhase> make_dynamic_tree();

}  // namespace trisect::hierarchies
