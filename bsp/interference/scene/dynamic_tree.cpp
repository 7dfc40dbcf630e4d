// SPDX-License-Identifier: Apache-2.0
//
// Where a leaf enters: its own box and the growth of all boxes above the place is what it adds to
// the sum of areas. Going down, the growth so far plus the leaf's own area is a bound, so that
// parts that cannot be better are left out (Bittner, Hapala and Havran 2013; Catto 2019).
//
// Repair: at every node on the way up a child may change places with a grandchild on the other
// side. The node's own box does not change by that, only that of the child which gets another
// grandchild; the best of the four exchanges is done if its area shrinks.

#include <trisect/bsp/interference/scene/dynamic_tree.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include <trisect/bsp/interference/boxes/tree_builder.h>
#include <trisect/kernel/contract.h>

namespace trisect::hierarchies {

namespace {

using Box = DynamicTree::Box;

Box around(const Box& a, const Box& b) {
    Box r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] = std::min(a.lo[k], b.lo[k]);
        r.hi[k] = std::max(a.hi[k], b.hi[k]);
    }
    return r;
}

double area(const Box& b) {
    const double x = b.hi[0] - b.lo[0];
    const double y = b.hi[1] - b.lo[1];
    const double z = b.hi[2] - b.lo[2];
    return x * y + y * z + z * x;
}

bool is_within(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.lo[k] < b.lo[k] || a.hi[k] > b.hi[k]) return false;
    return true;
}

}  // namespace

std::uint32_t DynamicTree::new_node() {
    if (!free_.empty()) {
        const std::uint32_t n = free_.back();
        free_.pop_back();
        nodes_[n] = {};
        return n;
    }
    nodes_.emplace_back();
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t DynamicTree::best_sibling(const Box& box) const {
    struct Open {
        std::uint32_t node;
        double growth;  // of the boxes above it
    };
    const double own = area(box);
    std::uint32_t best = root_;
    double least = std::numeric_limits<double>::infinity();
    std::vector<Open> open{{root_, 0}};
    while (!open.empty()) {
        const Open o = open.back();
        open.pop_back();
        if (o.growth + own >= least) continue;
        const Node& n = nodes_[o.node];
        const double joined = area(around(n.box, box));
        if (o.growth + joined < least) {
            least = o.growth + joined;
            best = o.node;
        }
        if (n.is_leaf()) continue;
        const double growth = o.growth + joined - area(n.box);
        // The child that grows less is looked at first.
        const auto grows = [&](std::uint32_t c) {
            return area(around(nodes_[c].box, box)) - area(nodes_[c].box);
        };
        const bool first = grows(n.child[0]) <= grows(n.child[1]);
        open.push_back({n.child[first ? 1 : 0], growth});
        open.push_back({n.child[first ? 0 : 1], growth});
    }
    return best;
}

void DynamicTree::put_leaf(std::uint32_t leaf) {
    if (root_ == none) {
        root_ = leaf;
        nodes_[leaf].parent = none;
        return;
    }
    const std::uint32_t sibling = best_sibling(nodes_[leaf].box);
    const std::uint32_t parent = new_node();
    const std::uint32_t above = nodes_[sibling].parent;
    nodes_[parent].parent = above;
    nodes_[parent].child[0] = sibling;
    nodes_[parent].child[1] = leaf;
    nodes_[sibling].parent = nodes_[leaf].parent = parent;
    if (above == none)
        root_ = parent;
    else
        nodes_[above].child[nodes_[above].child[0] == sibling ? 0 : 1] = parent;
    repair_from(parent);
}

void DynamicTree::take_leaf(std::uint32_t leaf) {
    const std::uint32_t parent = nodes_[leaf].parent;
    if (parent == none) {
        root_ = none;
        return;
    }
    const std::uint32_t above = nodes_[parent].parent;
    const std::uint32_t sibling = nodes_[parent].child[nodes_[parent].child[0] == leaf ? 1 : 0];
    nodes_[sibling].parent = above;
    free_.push_back(parent);
    if (above == none) {
        root_ = sibling;
        return;
    }
    nodes_[above].child[nodes_[above].child[0] == parent ? 0 : 1] = sibling;
    repair_from(above);
}

void DynamicTree::repair_from(std::uint32_t node) {
    while (node != none) {
        Node& n = nodes_[node];
        const Box box = around(nodes_[n.child[0]].box, nodes_[n.child[1]].box);
        ++updates_;
        n.box = box;
        rotate(node);
        node = n.parent;
    }
}

void DynamicTree::rotate(std::uint32_t node) {
    const Node& n = nodes_[node];
    double most = 0;
    std::uint32_t upper = none;
    std::uint32_t lower = none;
    for (std::size_t side = 0; side < 2; ++side) {
        const Node& opened = nodes_[n.child[side]];
        if (opened.is_leaf()) continue;
        const std::uint32_t other = n.child[1 - side];
        for (std::size_t k = 0; k < 2; ++k) {
            // Grandchild k goes up, the other child comes down in its place.
            const Box box = around(nodes_[other].box, nodes_[opened.child[1 - k]].box);
            const double gain = area(opened.box) - area(box);
            if (gain > most) {
                most = gain;
                upper = other;
                lower = opened.child[k];
            }
        }
    }
    if (upper != none) exchange(upper, lower);
}

void DynamicTree::exchange(std::uint32_t upper, std::uint32_t lower) {
    const std::uint32_t above = nodes_[upper].parent;
    const std::uint32_t middle = nodes_[lower].parent;
    nodes_[above].child[nodes_[above].child[0] == upper ? 0 : 1] = lower;
    nodes_[middle].child[nodes_[middle].child[0] == lower ? 0 : 1] = upper;
    nodes_[lower].parent = above;
    nodes_[upper].parent = middle;
    Node& m = nodes_[middle];
    m.box = around(nodes_[m.child[0]].box, nodes_[m.child[1]].box);
    ++updates_;
}

void DynamicTree::insert(std::uint32_t slot, const Box& box) {
    TRISECT_EXPECTS(!contains(slot), "the slot has a box already");
    if (slot >= leaf_.size()) leaf_.resize(std::size_t{slot} + 1, none);
    const std::uint32_t leaf = new_node();
    nodes_[leaf].box = box;
    nodes_[leaf].slot = slot;
    leaf_[slot] = leaf;
    ++size_;
    ++updates_;
    put_leaf(leaf);
}

void DynamicTree::remove(std::uint32_t slot) {
    TRISECT_EXPECTS(contains(slot), "no box has this slot");
    const std::uint32_t leaf = std::exchange(leaf_[slot], none);
    take_leaf(leaf);
    nodes_[leaf].slot = none;
    free_.push_back(leaf);
    --size_;
}

void DynamicTree::update(std::uint32_t slot, const Box& box) {
    TRISECT_EXPECTS(contains(slot), "no box has this slot");
    const std::uint32_t leaf = leaf_[slot];
    if (nodes_[leaf].box == box) return;
    const std::uint32_t parent = nodes_[leaf].parent;
    ++updates_;
    // What stays within its parent's box is repaired in place: a refit.
    if (parent == none || is_within(box, nodes_[parent].box)) {
        nodes_[leaf].box = box;
        repair_from(parent);
        return;
    }
    take_leaf(leaf);
    nodes_[leaf].box = box;
    nodes_[leaf].parent = none;
    put_leaf(leaf);
}

void DynamicTree::rebuild() {
    if (size_ == 0) return;
    std::vector<std::uint32_t> slots;
    std::vector<TreeItem> items;
    for (std::uint32_t s = 0; s < leaf_.size(); ++s) {
        if (leaf_[s] == none) continue;
        const Box& b = nodes_[leaf_[s]].box;
        TreeItem item{{}, b.lo, b.hi};
        for (std::size_t k = 0; k < 3; ++k) item.center[k] = 0.5 * (b.lo[k] + b.hi[k]);
        slots.push_back(s);
        items.push_back(item);
    }
    const TreeShape shape = build_tree(items, {});
    std::vector<Node> nodes(shape.nodes.size());
    for (std::uint32_t i = static_cast<std::uint32_t>(nodes.size()); i-- > 0;) {
        const TreeNode& n = shape.nodes[i];
        if (n.leaf) {
            const std::uint32_t item = shape.order[n.first];
            nodes[i].slot = slots[item];
            nodes[i].box = {items[item].lo, items[item].hi};
            leaf_[slots[item]] = i;
            continue;
        }
        for (std::uint32_t k = 0; k < 2; ++k) {
            nodes[i].child[k] = n.first + k;
            nodes[n.first + k].parent = i;
        }
        nodes[i].box = around(nodes[n.first].box, nodes[n.first + 1].box);
    }
    updates_ += nodes.size();
    nodes_ = std::move(nodes);
    free_.clear();
    root_ = 0;
}

void DynamicTree::find(const Box& box, FunctionRef<void(std::uint32_t)> visit,
                       CostCounters& counters) const {
    if (root_ == none) return;
    std::vector<std::uint32_t> stack{root_};
    while (!stack.empty()) {
        const Node& n = nodes_[stack.back()];
        stack.pop_back();
        ++counters.volume_tests;
        if (!n.box.meets(box)) continue;
        if (n.is_leaf()) {
            visit(n.slot);
        } else {
            stack.push_back(n.child[1]);
            stack.push_back(n.child[0]);
        }
    }
}

void DynamicTree::pairs(std::vector<detail::BodyPair>& out, CostCounters& counters) const {
    out.clear();
    if (root_ == none) return;
    // A node with itself, or two nodes beside each other.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{root_, root_}};
    const auto push = [&](std::uint32_t i, std::uint32_t j) {
        ++counters.volume_tests;
        if (nodes_[i].box.meets(nodes_[j].box)) stack.emplace_back(i, j);
    };
    while (!stack.empty()) {
        const auto [i, j] = stack.back();
        stack.pop_back();
        const Node& a = nodes_[i];
        const Node& b = nodes_[j];
        if (i == j) {
            if (a.is_leaf()) continue;
            stack.emplace_back(a.child[0], a.child[0]);
            stack.emplace_back(a.child[1], a.child[1]);
            push(a.child[0], a.child[1]);
        } else if (a.is_leaf() && b.is_leaf()) {
            out.push_back({std::min(a.slot, b.slot), std::max(a.slot, b.slot)});
        } else if (a.is_leaf() || (!b.is_leaf() && area(b.box) > area(a.box))) {
            push(i, b.child[0]);
            push(i, b.child[1]);
        } else {
            push(a.child[0], j);
            push(a.child[1], j);
        }
    }
    std::ranges::sort(out);
}

double DynamicTree::quality() const {
    if (root_ == none || nodes_[root_].is_leaf()) return 0;
    double sum = 0;
    std::vector<std::uint32_t> stack{root_};
    while (!stack.empty()) {
        const Node& n = nodes_[stack.back()];
        stack.pop_back();
        if (n.is_leaf()) continue;
        sum += area(n.box);
        stack.insert(stack.end(), std::begin(n.child), std::end(n.child));
    }
    const double whole = area(nodes_[root_].box);
    return whole > 0 ? sum / whole : 0;
}

unsigned DynamicTree::depth() const {
    unsigned most = 0;
    std::vector<std::pair<std::uint32_t, unsigned>> stack;
    if (root_ != none) stack.emplace_back(root_, 1U);
    while (!stack.empty()) {
        const auto [i, level] = stack.back();
        stack.pop_back();
        most = std::max(most, level);
        if (nodes_[i].is_leaf()) continue;
        stack.emplace_back(nodes_[i].child[0], level + 1);
        stack.emplace_back(nodes_[i].child[1], level + 1);
    }
    return most;
}

bool DynamicTree::is_sound() const {
    std::size_t leaves = 0;
    std::vector<std::uint32_t> stack;
    if (root_ != none) stack.push_back(root_);
    if (root_ != none && nodes_[root_].parent != none) return false;
    while (!stack.empty()) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        const Node& n = nodes_[i];
        if (n.is_leaf()) {
            ++leaves;
            if (leaf_[n.slot] != i) return false;
            continue;
        }
        for (const std::uint32_t c : n.child) {
            if (nodes_[c].parent != i) return false;
            stack.push_back(c);
        }
        if (n.box != around(nodes_[n.child[0]].box, nodes_[n.child[1]].box)) return false;
    }
    return leaves == size_;
}

namespace {

class DynamicTreePhase final : public detail::BroadPhase {
public:
    void insert(std::uint32_t slot, const detail::BodyBox& box) override {
        tree_.insert(slot, box);
    }
    void update(std::uint32_t slot, const detail::BodyBox& box) override {
        tree_.update(slot, box);
    }
    void remove(std::uint32_t slot) override { tree_.remove(slot); }
    void pairs(std::vector<detail::BodyPair>& out) override {
        CostCounters counters;
        tree_.pairs(out, counters);
        counts_ = {static_cast<std::size_t>(counters.volume_tests),
                   static_cast<std::size_t>(tree_.updates() - updates_)};
        updates_ = tree_.updates();
    }
    [[nodiscard]] std::size_t bytes() const override { return tree_.bytes(); }

private:
    DynamicTree tree_;
    std::uint64_t updates_ = 0;
};

}  // namespace

std::unique_ptr<detail::BroadPhase> make_dynamic_tree() {
    return std::make_unique<DynamicTreePhase>();
}

}  // namespace trisect::hierarchies
