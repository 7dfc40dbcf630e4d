// SPDX-License-Identifier: Apache-2.0
//
// A binary space partition as a solid.
//
// Thibault and Naylor (1987) observed that the tree by which Fuchs, Kedem and Naylor had sorted
// polygons for drawing is a solid when its leaves carry a label: every leaf is a convex cell that
// is wholly inside or wholly outside. A point finds its cell with one sign per level, and there is
// no ray to cast, hence no ray to go through a vertex.
//
// What is delicate is the point on a plane. The naive way sends it to one side, by convention, and
// reports the label it finds there; points of faces then come out inside or outside according to
// the orientation of a plane that may belong to a face far away. So both sides are visited and the
// labels compared: the point is inside when all cells that it touches are inside, and on the
// boundary when they differ. That is exact only when no cell is empty. An empty cell is bounded by
// half-spaces whose closures may still have a point in common, and its label means nothing; see the
// second invariant in the header, which every algorithm on these trees has to keep.
//
// Convex solids have trees that are lists, each plane cutting off an empty outside. With 10^4 faces
// a recursion over such a list needs megabytes of stack, which a thread need not have. All walks
// here are loops: since children have larger numbers than their parents, a pass in ascending order
// sees parents first and a pass in descending order sees children first.

#include <trisect/bsp/bsp_tree.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

using BspLabel = BspTree::Label;
using Membership = BspTree::Membership;
using BspNode = BspTree::Node;
using BspNodeId = BspTree::NodeId;

BspNodeId opposite_leaf(BspNodeId leaf) {
    return BspNodeId(leaf.label() == BspLabel::In ? BspLabel::Out : BspLabel::In);
}

/// Labels of the leaves whose closed cells hold the point.
template <class AnyPoint>
Membership classify_point(const BspTree& tree, const AnyPoint& p) {
    bool touches_in = false;
    bool touches_out = false;
    std::vector<BspNodeId> pending{tree.root()};
    while (!pending.empty()) {
        BspNodeId at = pending.back();
        pending.pop_back();
        while (!at.is_leaf()) {
            const BspNode& node = tree.node(at);
            const Side side = side_of(p, node.plane);
            if (side == Side::On) pending.push_back(node.above);
            at = side == Side::Above ? node.above : node.below;
        }
        (at.label() == BspLabel::In ? touches_in : touches_out) = true;
        if (touches_in && touches_out) return Membership::OnBoundary;
    }
    return touches_in ? Membership::Inside : Membership::Outside;
}

/// Finds subtrees that are equal node by node and drops the nodes that have two equal children.
class Reducer {
public:
    explicit Reducer(std::span<const BspNode> nodes) : nodes_(nodes), kept_as_(nodes.size()) {}

    BspTree run() {
        for (std::size_t i = nodes_.size(); i-- > 0;) kept_as_[i] = canonical(nodes_[i]);
        return nodes_.empty() ? BspTree() : copy(kept_as_[0]);
    }

private:
    BspNodeId resolved(BspNodeId id) const { return id.is_leaf() ? id : kept_as_[id.index()]; }

    // Equal subtrees get the number of the one that was met first. Between canonical children,
    // equality of subtrees is equality of ids.
    BspNodeId canonical(const BspNode& node) {
        const BspNode with{node.plane, resolved(node.below), resolved(node.above)};
        if (with.below == with.above) return with.below;
        const auto [first, last] = by_hash_.equal_range(hash(with));
        for (auto it = first; it != last; ++it) {
            const BspNode& known = canonical_[it->second];
            if (known.below == with.below && known.above == with.above && known.plane == with.plane)
                return BspNodeId(it->second);
        }
        const auto id = static_cast<std::uint32_t>(canonical_.size());
        by_hash_.emplace(hash(with), id);
        canonical_.push_back(with);
        return BspNodeId(id);
    }

    static std::size_t hash(const BspNode& node) {
        std::uint64_t h = 0;
        const auto mix = [&h](std::uint64_t v) { h = (h ^ v) * 0x9e3779b97f4a7c15U + (h >> 29U); };
        mix(child_key(node.below));
        mix(child_key(node.above));
        // Coefficients of planes through fractions may be multiples of 2^64.
        for (int limb = 0; limb < 2; ++limb) {
            for (int i = 0; i < 3; ++i) mix(node.plane.normal(i).limb(limb));
            mix(node.plane.offset().limb(limb));
        }
        return static_cast<std::size_t>(h);
    }
    static std::uint64_t child_key(BspNodeId id) {
        if (id.is_leaf()) return id.label() == BspLabel::In ? 1 : 0;
        return std::uint64_t{id.index()} + 2;
    }

    // Canonical subtrees may be used several times; a tree repeats them.
    BspTree copy(BspNodeId root) const {
        if (root.is_leaf()) return BspTree(root.label());
        std::vector<BspNode> result{canonical_[root.index()]};
        for (std::size_t i = 0; i < result.size(); ++i) {
            for (BspNodeId BspNode::*child : {&BspNode::below, &BspNode::above}) {
                const BspNodeId old = result[i].*child;
                if (old.is_leaf()) continue;
                result[i].*child = BspNodeId(static_cast<std::uint32_t>(result.size()));
                result.push_back(canonical_[old.index()]);
            }
        }
        return BspTree(std::move(result));
    }

    std::span<const BspNode> nodes_;
    std::vector<BspNodeId> kept_as_;  // what remains of each node, as an id into canonical_
    std::vector<BspNode> canonical_;
    std::unordered_multimap<std::size_t, std::uint32_t> by_hash_;
};

}  // namespace

BspTree::BspTree(std::vector<BspNode> nodes) : nodes_(std::move(nodes)) {
    if (!nodes_.empty()) root_ = BspNodeId(std::uint32_t{0});
    validate();
}

BspTree BspTree::half_space(const Plane& plane) {
    return BspTree({{plane, BspNodeId(BspLabel::In), BspNodeId(BspLabel::Out)}});
}

std::size_t BspTree::depth() const {
    std::vector<std::size_t> level(nodes_.size(), 1);
    std::size_t deepest = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        deepest = std::max(deepest, level[i]);
        for (const BspNodeId child : {nodes_[i].below, nodes_[i].above})
            if (!child.is_leaf()) level[child.index()] = level[i] + 1;
    }
    return deepest;
}

BspTree BspTree::complement() const {
    BspTree result = *this;
    if (result.root_.is_leaf()) result.root_ = opposite_leaf(result.root_);
    for (BspNode& node : result.nodes_) {
        if (node.below.is_leaf()) node.below = opposite_leaf(node.below);
        if (node.above.is_leaf()) node.above = opposite_leaf(node.above);
    }
    return result;
}

BspTree BspTree::reduced() const { return nodes_.empty() ? *this : Reducer(nodes_).run(); }

BspTree::Membership BspTree::classify(const LatticePoint& p) const {
    return classify_point(*this, p);
}

BspTree::Membership BspTree::classify(const Point& p) const { return classify_point(*this, p); }

void BspTree::validate() const {
    const auto refuse = [](std::size_t i, const char* why) {
        throw Error(ErrorCode::Internal, "BSP tree: node " + std::to_string(i) + " " + why);
    };
    if (nodes_.empty() != root_.is_leaf()) refuse(0, "is the root and missing or unused");
    std::vector<bool> has_parent(nodes_.size(), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!nodes_[i].plane.is_valid()) refuse(i, "has no plane");
        if (i > 0 && !has_parent[i]) refuse(i, "has no parent before it");
        for (const BspNodeId child : {nodes_[i].below, nodes_[i].above}) {
            if (child.is_leaf()) continue;
            if (child.index() >= nodes_.size()) refuse(i, "has a child that does not exist");
            if (child.index() <= i) refuse(i, "has a child with a smaller number");
            if (has_parent[child.index()]) refuse(child.index(), "has two parents");
            has_parent[child.index()] = true;
        }
    }
}

}  // namespace trisect
