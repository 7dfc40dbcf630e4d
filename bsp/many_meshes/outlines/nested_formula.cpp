// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/nested_formula.h>

#include <algorithm>

#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t most_levels = 64;

}  // namespace

std::optional<NestedFormula> NestedFormula::read(const Residual& formula, std::size_t slots) {
    NestedFormula out(slots);
    if (!out.add(formula, false, none)) return std::nullopt;
    const bool is_nested =
        std::ranges::any_of(out.nodes_, [](const Node& n) { return n.slot < 0 && n.depth > 0; });
    const bool has_all = std::ranges::none_of(out.leaves_, [](auto n) { return n == none; });
    if (!is_nested || !has_all) return std::nullopt;
    return out;
}

bool NestedFormula::add(const Residual& f, bool negated, std::uint32_t parent) {
    if (f.kind == Residual::Kind::Not)
        return with_enough_stack([&] { return add(*f.children[0], !negated, parent); });
    if (f.kind == Residual::Kind::Xor || f.kind == Residual::Kind::Constant) return false;
    const bool is_slot = f.kind == Residual::Kind::Slot;
    const bool unites = (f.kind == Residual::Kind::Or) != negated;
    std::uint32_t number = parent;
    if (is_slot || parent == none || nodes_[parent].unites != unites) {
        number = static_cast<std::uint32_t>(nodes_.size());
        Node& n = nodes_.emplace_back();
        n.parent = parent == none ? number : parent;
        n.depth = parent == none ? 0 : nodes_[parent].depth + 1;
        if (n.depth > most_levels) return false;
        if (parent != none) nodes_[parent].terms.push_back(number);
    }
    if (is_slot) {
        const auto slot = static_cast<std::size_t>(f.slot);
        if (leaves_[slot] != none) return false;
        nodes_[number].slot = f.slot;
        leaves_[slot] = number;
        positive_[slot] = negated ? 0 : 1;
        return true;
    }
    nodes_[number].unites = unites;
    return std::ranges::all_of(f.children, [&](const Residual::Ref& c) {
        return with_enough_stack([&] { return add(*c, negated, number); });
    });
}

NestedFormula NestedFormula::without(std::span<const std::uint8_t> operands) const {
    NestedFormula out(0);
    std::vector<std::uint32_t> numbers(nodes_.size(), none);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.slot >= 0 && operands[static_cast<std::size_t>(node.slot)] != 0) continue;
        numbers[n] = static_cast<std::uint32_t>(out.nodes_.size());
        out.nodes_.push_back({node.slot, node.unites, numbers[node.parent], node.depth, {}});
        if (n != root) out.nodes_[numbers[node.parent]].terms.push_back(numbers[n]);
    }
    for (std::size_t s = 0; s < leaves_.size(); ++s) {
        if (operands[s] != 0) continue;
        out.nodes_[numbers[leaves_[s]]].slot = static_cast<std::int32_t>(out.leaves_.size());
        out.leaves_.push_back(numbers[leaves_[s]]);
        out.positive_.push_back(positive_[s]);
    }
    return out;
}

bool NestedFormula::is_intersected(std::size_t slot) const {
    const Node& parent = nodes_[nodes_[leaves_[slot]].parent];
    return !parent.unites && std::ranges::any_of(parent.terms, [&](std::uint32_t t) {
        return t != leaves_[slot] && nodes_[t].slot >= 0 &&
               is_positive(static_cast<std::size_t>(nodes_[t].slot));
    });
}

bool NestedFormula::unites(std::uint32_t slot, std::uint32_t other) const {
    std::uint32_t a = leaves_[slot];
    std::uint32_t b = leaves_[other];
    while (a != b) {
        if (nodes_[a].depth < nodes_[b].depth) std::swap(a, b);
        a = nodes_[a].parent;
    }
    return nodes_[a].unites;
}

}  // namespace trisect::detail
