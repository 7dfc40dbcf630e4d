// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_classification.h>

#include <algorithm>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

void LeafClassification::classify(LeafWork& work, LeafLinks& links) {
    work_ = &work;
    links_ = &links;
    std::int32_t last_slot = -1;
    for (const LeafOperand& o : work.problem->operands) last_slot = std::max(last_slot, o.slot);
    values_.assign(as_index(last_slot + 1), -1);
    windings_.start(work);
    sides_.assign(work.items.size() + work.pieces.size(), std::nullopt);
    choose_roots();
    for (const LeafNode root : roots_)
        if (root >= 0) classify_tree(root);
}

// Easiest to trace to is a facet in the cell; then a piece; and a facet that the cell would have to
// clip comes last.
void LeafClassification::choose_roots() {
    const LeafIndex items = work_->item_count();
    roots_.assign(sides_.size(), -1);
    const auto rank = [&](LeafNode node) {
        if (node >= items) return 1;
        return work_->item(node).contained ? 0 : 2;
    };
    for (LeafNode node = 0; node < static_cast<LeafNode>(sides_.size()); ++node) {
        if (node < items ? !work_->item(node).is_whole()
                         : work_->pieces[as_index(node - items)].dropped)
            continue;
        LeafNode& root = roots_[as_index(links_->tree_of(node))];
        if (root < 0 || rank(node) < rank(root)) root = node;
    }
}

template <class Visit>
void LeafClassification::walk(LeafNode root, const Visit& visit) {
    stack_.clear();
    stack_.push_back({root, -1, links_->first_link(root), -1});
    visit(root);
    while (!stack_.empty()) {
        Frame& f = stack_.back();
        if (f.link < 0) {
            if (f.arrival >= 0) apply(links_->link(f.arrival), -1);
            stack_.pop_back();
            continue;
        }
        const LeafIndex i = f.link;
        const LeafLinks::Link& link = links_->link(i);
        f.link = link.next;
        if (link.to == f.parent) continue;
        apply(link, 1);
        stack_.push_back({link.to, f.node, links_->first_link(link.to), i});
        visit(link.to);
    }
}

void LeafClassification::apply(const LeafLinks::Link& link, int sign) {
    for (const LeafChange& c : links_->changes(link)) {
        above_[as_index(c.operand)] += sign * link.sign * c.change;
        changed_ = true;
    }
}

void LeafClassification::classify_tree(LeafNode root) {
    const std::size_t n = work_->problem->operands.size();
    above_.assign(n, 0);
    known_.assign(n, 0);
    // An embedded operand has 0 outside its own facets and 1 inside.
    const LeafItem& item = work_->item(item_index(root));
    if (work_->operand_of(item).embedded) known_[as_index(item.operand)] = 1;
    collect_known(root);
    if (!trace_root(root)) return;
    changed_ = true;
    walk(root, [&](LeafNode node) { sides_[as_index(node)] = sides_at(node); });
}

// Winding numbers at the root from those that are known anywhere in its tree.
void LeafClassification::collect_known(LeafNode root) {
    if (!links_->any_known()) return;
    std::size_t missing = static_cast<std::size_t>(std::count(known_.begin(), known_.end(), 0));
    at_root_.assign(above_.size(), 0);
    walk(root, [&](LeafNode node) {
        for (LeafIndex k = links_->first_known(node); k >= 0 && missing > 0;
             k = links_->known(k).next) {
            const LeafLinks::Known& known = links_->known(k);
            const std::size_t o = as_index(known.operand);
            if (known_[o] != 0) continue;
            known_[o] = 1;
            at_root_[o] = known.winding - above_[o];
            --missing;
        }
    });
    above_ = at_root_;
}

// The other ones from a trace; false when the root is not in the cell.
bool LeafClassification::trace_root(LeafNode root) {
    const LeafIndex items = work_->item_count();
    const bool clips = root < items && !work_->item(root).contained;
    const bool traces = std::find(known_.begin(), known_.end(), 0) != known_.end();
    if (!clips && !traces) return true;
    set_step(root);
    if (!clips) {
        const WorkPolygon& part =
            root < items ? work_->shape(root) : work_->pieces[as_index(root - items)].shape;
        windings_.windings_above(item_index(root), part, step_, known_, above_);
        return true;
    }
    const WorkPolygon part = work_->bench.clipped(
        work_->with_edges(root), work_->item(root).ref.box(), work_->problem->cell);
    if (part.is_empty()) return false;
    if (traces) windings_.windings_above(root, part, step_, known_, above_);
    return true;
}

// How winding numbers change from above a node to below it.
void LeafClassification::set_step(LeafNode node) {
    const LeafIndex items = work_->item_count();
    const LeafIndex special = node < items ? -1 : work_->pieces[as_index(node - items)].step;
    if (special >= 0) {
        step_ = work_->steps[as_index(special)];
        return;
    }
    const LeafItem& item = work_->item(item_index(node));
    step_.assign(above_.size(), 0);
    step_[as_index(item.operand)] = item.orientation;
}

LeafSides LeafClassification::sides_at(LeafNode node) {
    const LeafIndex items = work_->item_count();
    const LeafItem& item = work_->item(item_index(node));
    const bool special = node >= items && work_->pieces[as_index(node - items)].step >= 0;
    if (!special && !changed_ && item.orientation == last_orientation_) return *last_;
    if (work_->operand_of(item).embedded)
        above_[as_index(item.operand)] = item.orientation > 0 ? 0 : 1;
    set_step(node);
    const LeafSides sides{formula_at(0), formula_at(1)};
    changed_ = special;
    last_ = sides;
    last_orientation_ = item.orientation;
    return sides;
}

// Above where the walk is, or `step_sign` steps below.
bool LeafClassification::formula_at(int step_sign) {
    for (std::size_t o = 0; o < above_.size(); ++o) {
        const LeafOperand& operand = work_->problem->operands[o];
        const int winding = above_[o] + step_sign * step_[o];
        values_[as_index(operand.slot)] =
            is_inside(winding, work_->problem->options->winding) ? 1 : 0;
    }
    return value_of(*work_->problem->formula, values_);
}

}  // namespace trisect::detail
