// SPDX-License-Identifier: Apache-2.0
//
// Merging two trees, after Naylor, Amanatides and Thibault (SIGGRAPH 1990).
//
// If one operand is a leaf, the result is the other one, its complement or a leaf: four bits of a
// truth table say which. Otherwise take the root plane H of the first tree, partition the second
// tree into what it is below and above H, and merge the halves with the two children. The first
// tree is walked once; the second one is cut up along the way.
//
// Partitioning a tree by H is the heart. At a node with plane P the naive way computes on which
// side of H the *plane* P lies, which is nonsense unless they are parallel; what counts is what
// both planes do within the cell of the node. So every node carries the section of its plane by its
// cell (bsp_sections.h), and H is carried along as the section h of the same cell:
//
//     h lies in P           the children are the halves, swapped if the orientations differ;
//     P cuts h              H cuts the section p as well: both halves get a node with plane P, and
//                           both children are partitioned by their part of h;
//     h on one side of P    then p is on one side of H. The child of P without h goes to that half
//                           untouched, under a node with plane P; the other child is partitioned
//                           and one of its halves becomes the sibling.
//
// All three are exact classifications of convex polygons, and the second and third cannot
// contradict each other: both sides of "P cuts h" say that the planes' common line meets the open
// cell. Every plane of a result cuts its cell, because its section is at hand, with area. Naylor et
// al. clip the new plane by all ancestors at each node, linear in the depth; with sections carried
// along, one classification of h and one of p per visited node do.
//
// Without reduction the halves fill up with nodes that separate nothing (the part of a box's list
// that is far from the box), and each further partition cuts them again. So nodes whose children
// turn into equal leaves are dropped after each partition; Bernstein and Fussell (2009) found the
// same step decisive.
//
// The working tree is linked, and owned linearly: a node is in one tree only, a partition turns one
// tree into two in place and makes a node only where a section is cut. Memory is therefore that of
// the parts that are alive. "Slots" (a node and one of its children) are filled top-down by
// explicit stacks; there is no recursion.

#include <trisect/bsp/bsp_merge.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/classic/bsp_sections.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

using BspLabel = BspTree::Label;
using BspNodeId = BspTree::NodeId;
using Children = std::array<BspNodeId, 2>;  // below, above

constexpr std::size_t half_of(Side side) { return side == Side::Above ? 1 : 0; }

/// A place where the root of a subtree is written.
struct Slot {
    std::uint32_t node = 0;
    std::size_t half = 0;
};

/// The linked nodes of all trees in work, with their sections.
class WorkForest {
public:
    [[nodiscard]] const ConvexPolygon& section(BspNodeId id) const { return sections_[id.index()]; }
    ConvexPolygon& section(BspNodeId id) { return sections_[id.index()]; }
    [[nodiscard]] const Children& children(BspNodeId id) const { return children_[id.index()]; }
    [[nodiscard]] BspNodeId at(Slot slot) const { return children_[slot.node][slot.half]; }
    void put(Slot slot, BspNodeId id) { children_[slot.node][slot.half] = id; }

    /// A node without meaning whose children are roots.
    std::uint32_t add_anchor() { return add(ConvexPolygon(), {}).index(); }

    BspNodeId add(ConvexPolygon section, Children children) {
        if (free_.empty()) {
            sections_.push_back(std::move(section));
            children_.push_back(children);
            return BspNodeId(static_cast<std::uint32_t>(sections_.size() - 1));
        }
        const BspNodeId id = free_.back();
        free_.pop_back();
        sections_[id.index()] = std::move(section);
        children_[id.index()] = children;
        return id;
    }

    BspNodeId add_tree(const BspTree& tree) {
        if (tree.root().is_leaf()) return tree.root();
        const auto first = static_cast<std::uint32_t>(sections_.size());
        const auto moved = [first](BspNodeId id) {
            return id.is_leaf() ? id : BspNodeId(id.index() + first);
        };
        for (ConvexPolygon& section : cell_sections(tree)) sections_.push_back(std::move(section));
        for (const BspTree::Node& node : tree.nodes())
            children_.push_back({moved(node.below), moved(node.above)});
        return BspNodeId(first);
    }

    void remove(BspNodeId id) {
        sections_[id.index()] = ConvexPolygon();
        free_.push_back(id);
    }

    /// The nodes of a tree, parents first.
    [[nodiscard]] std::vector<BspNodeId> nodes_of(BspNodeId root) const {
        std::vector<BspNodeId> order;
        if (!root.is_leaf()) order.push_back(root);
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const BspNodeId child : children(order[i]))
                if (!child.is_leaf()) order.push_back(child);
        return order;
    }

    /// What is left of a tree as one operand when the other one is known.
    BspNodeId apply(UnaryRule rule, BspNodeId root) {
        if (rule == UnaryRule::Keep) return root;
        const std::vector<BspNodeId> order = nodes_of(root);
        if (rule == UnaryRule::Complement) {
            for (const BspNodeId id : order)
                for (BspNodeId& child : children_[id.index()]) child = complemented(child);
            return complemented(root);
        }
        for (const BspNodeId id : order) remove(id);
        return BspNodeId(rule == UnaryRule::In ? BspLabel::In : BspLabel::Out);
    }

    /// Replaces a child that has two equal leaves by such a leaf.
    void drop_useless_children(std::uint32_t node) {
        for (BspNodeId& child : children_[node]) {
            if (child.is_leaf()) continue;
            const Children grandchildren = children(child);
            if (!grandchildren[0].is_leaf() || grandchildren[0] != grandchildren[1]) continue;
            remove(child);
            child = grandchildren[0];
        }
    }

    [[nodiscard]] BspTree to_tree(BspNodeId root) const {
        if (root.is_leaf()) return BspTree(root.label());
        const std::vector<BspNodeId> order = nodes_of(root);
        std::vector<BspNodeId> number(children_.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            number[order[i].index()] = BspNodeId(static_cast<std::uint32_t>(i));
        const auto renumbered = [&](BspNodeId id) {
            return id.is_leaf() ? id : number[id.index()];
        };
        std::vector<BspTree::Node> nodes;
        nodes.reserve(order.size());
        for (const BspNodeId id : order)
            nodes.push_back(
                {section(id).support(), renumbered(children(id)[0]), renumbered(children(id)[1])});
        return BspTree(std::move(nodes));
    }

private:
    static BspNodeId complemented(BspNodeId id) {
        if (!id.is_leaf()) return id;
        return BspNodeId(id.label() == BspLabel::In ? BspLabel::Out : BspLabel::In);
    }

    std::vector<ConvexPolygon> sections_;
    std::vector<Children> children_;
    std::vector<BspNodeId> free_;
};

/// Cuts a tree of the forest into what it is below and above a plane.
class Partitioner {
public:
    explicit Partitioner(WorkForest& forest) : forest_(forest), anchor_(forest.add_anchor()) {}

    /// Consumes the tree. \param cut the section of the tree's cell by the plane.
    Children run(BspNodeId tree, const ConvexPolygon& cut) {
        touched_.assign(1, anchor_);
        pending_.push_back({tree, cut, {Slot{anchor_, 0}, Slot{anchor_, 1}}});
        while (!pending_.empty()) {
            Task task = std::move(pending_.back());
            pending_.pop_back();
            while (!task.tree.is_leaf()) {
                if (!descend(task)) break;
            }
            if (task.tree.is_leaf())
                for (const Slot slot : task.to) forest_.put(slot, task.tree);
        }
        for (std::size_t i = touched_.size(); i-- > 0;) forest_.drop_useless_children(touched_[i]);
        return {forest_.at({anchor_, 0}), forest_.at({anchor_, 1})};
    }

private:
    struct Task {
        BspNodeId tree;
        ConvexPolygon cut;
        std::array<Slot, 2> to;  // where the parts below and above the cutting plane go
    };

    /// Moves the task to a child. \return false when the task is finished.
    bool descend(Task& task) {
        const BspNodeId id = task.tree;
        const Plane plane = forest_.section(id).support();
        ConvexPolygon cut_above;
        const auto parts = task.cut.split(plane, task.cut, cut_above);
        if (parts.is_coplanar()) {
            finish_coplanar(task, same_orientation(plane, task.cut.support()));
            return false;
        }
        if (parts.is_cut())
            split_node(task, std::move(cut_above));
        else
            pass_node(task, parts.side());
        return true;
    }

    void finish_coplanar(const Task& task, bool same) {
        const Children children = forest_.children(task.tree);
        forest_.put(task.to[0], children[same ? 0 : 1]);
        forest_.put(task.to[1], children[same ? 1 : 0]);
        forest_.remove(task.tree);
    }

    // The cutting plane and the node's plane cross in the cell.
    void split_node(Task& task, ConvexPolygon cut_above) {
        const BspNodeId lower = task.tree;
        const Children children = forest_.children(lower);
        ConvexPolygon upper_section;
        ConvexPolygon& section = forest_.section(lower);
        const auto parts = section.split(task.cut.support(), section, upper_section);
        TRISECT_EXPECTS(parts.is_cut(), "only one of two crossing sections is cut");
        const BspNodeId upper = forest_.add(std::move(upper_section), {});
        const std::array<std::uint32_t, 2> halves{lower.index(), upper.index()};
        for (std::size_t h = 0; h < 2; ++h) {
            forest_.put(task.to[h], BspNodeId(halves[h]));
            touched_.push_back(halves[h]);
        }
        pending_.push_back(
            {children[1], std::move(cut_above), {Slot{halves[0], 1}, Slot{halves[1], 1}}});
        task.tree = children[0];
        task.to = {Slot{halves[0], 0}, Slot{halves[1], 0}};
    }

    // The cutting plane meets only one child, on the given side of the node's plane.
    void pass_node(Task& task, Side met) {
        const BspNodeId id = task.tree;
        const auto parts = forest_.section(id).classify(task.cut.support());
        TRISECT_EXPECTS(!parts.is_cut() && !parts.is_coplanar(), "sections disagree about a cut");
        const std::size_t half = half_of(parts.side());
        forest_.put(task.to[half], id);
        touched_.push_back(id.index());
        task.to[half] = {id.index(), half_of(met)};
        task.tree = forest_.children(id)[half_of(met)];
    }

    WorkForest& forest_;
    std::uint32_t anchor_;
    std::vector<std::uint32_t> touched_;  // parents before children
    std::vector<Task> pending_;
};

class Merger {
public:
    explicit Merger(BooleanRule rule)
        : rule_(rule), anchor_(forest_.add_anchor()), partitioner_(forest_) {}

    BspTree run(const BspTree& a, const BspTree& b) {
        const BspNodeId first = forest_.add_tree(a);
        pending_.push_back({first, forest_.add_tree(b), {anchor_, 0}});
        while (!pending_.empty()) {
            const Task task = pending_.back();
            pending_.pop_back();
            merge(task);
        }
        const BspNodeId root = forest_.at({anchor_, 0});
        const std::vector<BspNodeId> order = forest_.nodes_of(root);
        for (std::size_t i = order.size(); i-- > 0;)
            forest_.drop_useless_children(order[i].index());
        forest_.drop_useless_children(anchor_);
        return forest_.to_tree(forest_.at({anchor_, 0}));
    }

private:
    struct Task {
        BspNodeId first;
        BspNodeId second;
        Slot to;
    };

    void merge(const Task& task) {
        if (task.first.is_leaf()) {
            const UnaryRule left = rule_.given_first(task.first.label() == BspLabel::In);
            forest_.put(task.to, forest_.apply(left, task.second));
            return;
        }
        if (task.second.is_leaf()) {
            const UnaryRule left = rule_.given_second(task.second.label() == BspLabel::In);
            forest_.put(task.to, forest_.apply(left, task.first));
            return;
        }
        forest_.put(task.to, task.first);
        const Children children = forest_.children(task.first);
        const Children halves = partitioner_.run(task.second, forest_.section(task.first));
        const std::uint32_t node = task.first.index();
        pending_.push_back({children[1], halves[1], {node, 1}});
        pending_.push_back({children[0], halves[0], {node, 0}});
    }

    BooleanRule rule_;
    WorkForest forest_;
    std::uint32_t anchor_;
    Partitioner partitioner_;
    std::vector<Task> pending_;
};

}  // namespace

BspTree merge(const BspTree& a, const BspTree& b, BooleanRule rule) {
    return Merger(rule).run(a, b).reduced();
}

bool is_same_set(const BspTree& a, const BspTree& b) {
    const BspTree difference = merge(a, b, BooleanRule::symmetric_difference());
    return difference.root() == BspNodeId(BspLabel::Out);
}

}  // namespace trisect
