// SPDX-License-Identifier: Apache-2.0
//
// Values of the formula on both sides of a leaf's polygons.
#pragma once

#include <optional>
#include <vector>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/leaf/exact/leaf_links.h>
#include <trisect/bsp/leaf/exact/leaf_windings.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// The value of the formula just above and just below a polygon, in the sense of its support.
struct LeafSides {
    bool above = false;
    bool below = false;
    /// Such a polygon bounds the result.
    [[nodiscard]] bool differ() const { return above != below; }
};

/// Walks through the trees of links; each needs at most one trace. Scratch memory that is kept from
/// leaf to leaf.
class LeafClassification {
public:
    /// \pre the links are built.
    void classify(LeafWork& work, LeafLinks& links);
    /// Nothing for an item that was listed for its box but is not in the cell.
    [[nodiscard]] const std::optional<LeafSides>& sides(LeafNode node) const {
        return sides_[static_cast<std::size_t>(node)];
    }

private:
    struct Frame {
        LeafNode node = -1;
        LeafNode parent = -1;
        LeafIndex link = -1;     ///< next one to follow
        LeafIndex arrival = -1;  ///< link that led here
    };
    void choose_roots();
    void classify_tree(LeafNode root);
    void collect_known(LeafNode root);
    [[nodiscard]] bool trace_root(LeafNode root);
    [[nodiscard]] LeafSides sides_at(LeafNode node);
    [[nodiscard]] bool formula_at(int step_sign);
    void set_step(LeafNode node);
    void apply(const LeafLinks::Link& link, int sign);
    template <class Visit>
    void walk(LeafNode root, const Visit& visit);
    [[nodiscard]] LeafIndex item_index(LeafNode node) const {
        return node < work_->item_count()
                   ? node
                   : work_->pieces[as_index(node - work_->item_count())].item;
    }

    LeafWork* work_ = nullptr;
    LeafLinks* links_ = nullptr;
    SlotValues values_;
    LeafWindings windings_;
    std::vector<std::optional<LeafSides>> sides_;
    std::vector<LeafNode> roots_;  // of a tree: where to start
    std::vector<Frame> stack_;
    std::vector<int> above_;  // winding numbers where the walk is
    std::vector<int> at_root_;
    std::vector<char> known_;  // by operand
    std::vector<int> step_;
    bool changed_ = true;  // since the last time that the formula was evaluated
    std::optional<LeafSides> last_;
    int last_orientation_ = 0;
};

}  // namespace trisect::detail
