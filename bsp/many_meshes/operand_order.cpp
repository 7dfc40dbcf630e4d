// SPDX-License-Identifier: Apache-2.0
//
// Operands that leave open what is far out, as tools do, are clustered: of two that are apart
// nothing is compared. Others cut down whatever they meet. Where all tools are in the first
// operand, its facets stay whole until all of them come. Tools beside all that the others leave
// open do nothing. Where operands do not fill one place neighbours come first: then most of a
// solid is far from the other one.

#include <trisect/bsp/many_meshes/operand_order.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <trisect/bsp/many_meshes/crowd.h>
#include <trisect/bsp/many_meshes/imported_operands.h>
#include <trisect/bsp/many_meshes/operand_clusters.h>
#include <trisect/bsp/many_meshes/outlines/nested_formula.h>

namespace trisect::detail {

namespace {

constexpr std::size_t least_ordered = 32;

}  // namespace

OperandOrder::OperandOrder(const ManyMeshes& meshes, const SolidStates& solids) {
    for (std::size_t i = 0; i < solids.size(); ++i)
        is_open_far_.push_back(is_open_far_out(*solids[i], meshes.operands->operands[i]) ? 1 : 0);
    if (meshes.nested == nullptr)
        set_order(boxes_of(solids));
    else
        set_terms(meshes, solids);
}

// A box with what all leave open together: other operands leave all of it open, or none if it is
// empty.
std::optional<Box> OperandOrder::reach_of(const std::vector<Box>& boxes) const {
    std::optional<Box> out;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (!is_open_far(i)) out = out ? out->intersected(boxes[i]) : boxes[i];
    if (out && out->is_empty()) out.reset();
    return out;
}

void OperandOrder::set_order(const std::vector<Box>& boxes) {
    const Crowd crowd = crowd_of(boxes);
    first_is_last_ = crowd == Crowd::InFirst;
    const std::optional<Box> reach = reach_of(boxes);
    Slots all;
    Slots bounded;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (first_is_last_ && i == 0) continue;
        if (reach && is_open_far(i) && !boxes[i].overlaps(*reach)) continue;
        all.push_back(i);
        (is_open_far(i) ? bounded : order_).push_back(i);
    }
    clusters_ = operand_clusters(boxes, bounded);
    if (clusters_.size() > 1) {
        if (crowd != Crowd::All)
            for (auto& cluster : clusters_) order_in_space(boxes, cluster);
        return;
    }
    clusters_.clear();
    if (crowd != Crowd::All && bounded.size() == all.size()) order_in_space(boxes, all);
    order_ = std::move(all);
}

// Of nested operations.
void OperandOrder::set_terms(const ManyMeshes& meshes, const SolidStates& solids) {
    const NestedFormula& nested = *meshes.nested;
    for (std::uint32_t n = 0; n < nested.size(); ++n) terms_.push_back(nested.node(n).terms);
    if (!meshes.neighbours_come_first) return;
    boxes_ = boxes_of(solids);
    neighbours_.resize(terms_.size());
    for (std::uint32_t n = 0; n < terms_.size(); ++n)
        if (terms_[n].size() >= least_ordered) order_terms(nested, n);
}

// Operands first, or as neighbours.
void OperandOrder::order_terms(const NestedFormula& nested, std::uint32_t node) {
    std::vector<std::uint32_t>& terms = terms_[node];
    Slots slots;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : terms) {
        const std::int32_t slot = nested.node(t).slot;
        if (slot < 0)
            others.push_back(t);
        else
            slots.push_back(static_cast<std::uint32_t>(slot));
    }
    order_in_space(boxes_, slots);
    terms.clear();
    for (const std::uint32_t s : slots) terms.push_back(nested.leaf(s));
    terms.insert(terms.end(), others.begin(), others.end());
    const bool unites = nested.node(node).unites;
    if (std::ranges::any_of(slots, [&](std::uint32_t s) { return is_open_far(s) == unites; }))
        return;
    neighbours_[node] = std::move(slots);
    terms = std::move(others);
}

}  // namespace trisect::detail
