// SPDX-License-Identifier: Apache-2.0
//
// A sweep sorts links along an axis, a grid files them in cells, both anew in each frame and
// without knowing that a chain is one thing. Here the order is the chain's own and never changes;
// only boxes do. The tree is a complete one in an array: node i has children 2 i and 2 i + 1.

#include <trisect/bsp/interference/scene/chain_boxes.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trisect::hierarchies {

namespace {

using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::detail::BroadPhase;

class ChainBoxes final : public BroadPhase {
public:
    void insert(std::uint32_t slot, const BodyBox& box) override {
        if (slot >= leaves_) grow(slot);
        nodes_[leaves_ + slot].used = true;
        put(slot, box);
    }
    void update(std::uint32_t slot, const BodyBox& box) override {
        if (!(nodes_[leaves_ + slot].box == box)) put(slot, box);
    }
    void remove(std::uint32_t slot) override {
        nodes_[leaves_ + slot].used = false;
        mark_above(leaves_ + slot);
    }
    void pairs(std::vector<BodyPair>& out) override {
        counts_ = {};
        out.clear();
        if (leaves_ == 0) return;
        refit(1);
        within(1, out);
        std::sort(out.begin(), out.end());
    }
    [[nodiscard]] std::size_t bytes() const override { return nodes_.size() * sizeof(Node); }

private:
    struct Node {
        BodyBox box;
        bool used = false;  // anything below it
        bool stale = false;
    };

    void grow(std::uint32_t slot) {
        std::size_t leaves = leaves_ == 0 ? 16 : leaves_;
        while (leaves <= slot) leaves *= 2;
        std::vector<Node> nodes(2 * leaves);
        for (std::size_t i = 0; i < leaves_; ++i) nodes[leaves + i] = nodes_[leaves_ + i];
        for (std::size_t i = 1; i < leaves; ++i) nodes[i].stale = true;
        nodes_ = std::move(nodes);
        leaves_ = leaves;
    }

    void put(std::uint32_t slot, const BodyBox& box) {
        nodes_[leaves_ + slot].box = box;
        mark_above(leaves_ + slot);
    }

    // What is above a stale node is stale already.
    void mark_above(std::size_t node) {
        for (node /= 2; node != 0 && !nodes_[node].stale; node /= 2) nodes_[node].stale = true;
    }

    void refit(std::size_t node) {
        if (node >= leaves_ || !nodes_[node].stale) return;
        refit(2 * node);
        refit(2 * node + 1);
        Node& n = nodes_[node];
        const Node& l = nodes_[2 * node];
        const Node& r = nodes_[2 * node + 1];
        n.stale = false;
        n.used = l.used || r.used;
        if (n.used) ++counts_.moves;
        n.box = l.used ? l.box : r.box;
        if (!l.used || !r.used) return;
        for (std::size_t k = 0; k < 3; ++k) {
            n.box.lo[k] = std::min(l.box.lo[k], r.box.lo[k]);
            n.box.hi[k] = std::max(l.box.hi[k], r.box.hi[k]);
        }
    }

    // Pairs below a node.
    void within(std::size_t node, std::vector<BodyPair>& out) {
        if (node >= leaves_ || !nodes_[node].used) return;
        within(2 * node, out);
        within(2 * node + 1, out);
        between(2 * node, 2 * node + 1, out);
    }

    // Pairs of one below a and one below b, which are on one level.
    void between(std::size_t a, std::size_t b, std::vector<BodyPair>& out) {
        if (!nodes_[a].used || !nodes_[b].used) return;
        ++counts_.box_tests;
        if (!nodes_[a].box.meets(nodes_[b].box)) return;
        if (a >= leaves_) {
            out.push_back(
                {static_cast<std::uint32_t>(a - leaves_), static_cast<std::uint32_t>(b - leaves_)});
            return;
        }
        between(2 * a, 2 * b, out);
        between(2 * a, 2 * b + 1, out);
        between(2 * a + 1, 2 * b, out);
        between(2 * a + 1, 2 * b + 1, out);
    }

    std::vector<Node> nodes_;
    std::size_t leaves_ = 0;  // a power of two, or 0
};

}  // namespace

std::unique_ptr<BroadPhase> make_chain_boxes() { return std::make_unique<ChainBoxes>(); }

}  // namespace trisect::hierarchies
