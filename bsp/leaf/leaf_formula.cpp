// SPDX-License-Identifier: Apache-2.0
//
// Every operation counts its terms that are inside and those that are unknown; that gives its
// value. When a term changes, the counts of the operations that it is a term of change by one, and
// only where that changes a value does it go on. A formula is a graph: operations are updated in an
// order in which terms come first, so each one at most once.

#include <trisect/bsp/leaf/leaf_formula.h>

#include <algorithm>
#include <bit>
#include <utility>

#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

using FormulaKind = Residual::Kind;

namespace {

// Formulas of so many operands have a table.
constexpr std::size_t tabulated = 3;

}  // namespace

void LeafFormula::start(const LeafProblem& problem) {
    operands_ = problem.operands.size();
    rule_ = problem.options->winding;
    constant_ = -1;
    table_.clear();
    if (problem.formula->kind == FormulaKind::Constant) {
        constant_ = problem.formula->value ? 1 : 0;
    } else if (operands_ <= tabulated && !problem.formula->is_large()) {
        tabulate(problem);
        return;
    }
    nodes_.clear();
    parents_.clear();
    known_.clear();
    first_parent_.assign(operands_, -1);
    for (std::size_t o = 0; o < operands_; ++o) {
        const auto slot = static_cast<std::size_t>(problem.operands[o].slot);
        if (slot >= operand_of_slot_.size()) operand_of_slot_.resize(slot + 1);
        operand_of_slot_[slot] = static_cast<std::int32_t>(o);
    }
    remembers_ = problem.formula->is_large();
    if (constant_ < 0) root_ = compile(*problem.formula);
    dirty_.assign(nodes_.size() / 64 + 1, 0);
}

void LeafFormula::tabulate(const LeafProblem& problem) {
    std::size_t size = 1;
    std::int32_t last_slot = 0;
    for (const LeafOperand& o : problem.operands) {
        size *= 3;
        last_slot = std::max(last_slot, o.slot);
    }
    values_.assign(static_cast<std::size_t>(last_slot) + 1, -1);
    for (std::size_t entry = 0; entry < size; ++entry) {
        std::size_t digits = entry;
        for (std::size_t o = operands_; o-- > 0; digits /= 3)
            values_[static_cast<std::size_t>(problem.operands[o].slot)] =
                static_cast<std::int8_t>(static_cast<int>(digits % 3) - 1);
        table_.push_back(static_cast<std::int8_t>(bounded_value_of(*problem.formula, values_)));
    }
}

void LeafFormula::add_parent(std::int32_t& first, std::int32_t node) {
    parents_.push_back({node, first});
    first = static_cast<std::int32_t>(parents_.size()) - 1;
}

// The number of a node, or that of an operand as its complement.
std::int32_t LeafFormula::compile(const Residual& formula) {
    if (formula.kind == FormulaKind::Slot)
        return ~operand_of_slot_[static_cast<std::size_t>(formula.slot)];
    if (remembers_)
        if (const auto known = known_.find(&formula); known != known_.end()) return known->second;
    Node node;
    node.kind = formula.kind;
    node.terms = static_cast<int>(formula.children.size());
    std::vector<std::int32_t> terms;
    terms.reserve(formula.children.size());
    for (const Residual::Ref& c : formula.children) {
        if (c->kind == FormulaKind::Constant) {
            node.inside += c->value ? 1 : 0;
            continue;
        }
        terms.push_back(with_enough_stack([&] { return compile(*c); }));
        const int v = terms.back() >= 0 ? nodes_[static_cast<std::size_t>(terms.back())].value : -1;
        node.inside += v > 0 ? 1 : 0;
        node.unknown += v < 0 ? 1 : 0;
    }
    node.value = value_of(node, node.inside, node.unknown);
    const auto id = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(node);
    for (const std::int32_t t : terms)
        add_parent(t >= 0 ? nodes_[static_cast<std::size_t>(t)].first_parent
                          : first_parent_[static_cast<std::size_t>(~t)],
                   id);
    if (remembers_) known_.emplace(&formula, id);
    return id;
}

int LeafFormula::value_of(const Node& node, int inside, int unknown) {
    switch (node.kind) {
        case FormulaKind::And:
            return inside + unknown < node.terms ? 0 : (unknown > 0 ? -1 : 1);
        case FormulaKind::Or:
            return inside > 0 ? 1 : (unknown > 0 ? -1 : 0);
        case FormulaKind::Xor:
            return unknown > 0 ? -1 : inside % 2;
        case FormulaKind::Not:
            return unknown > 0 ? -1 : 1 - inside;
        case FormulaKind::Slot:
        case FormulaKind::Constant:
            break;
    }
    return -1;
}

void LeafFormula::tell_parents(std::span<int> row, std::int32_t first, int before, int after) {
    for (std::int32_t p = first; p >= 0; p = parents_[static_cast<std::size_t>(p)].next) {
        const auto node = static_cast<std::size_t>(parents_[static_cast<std::size_t>(p)].node);
        int* c = counts(row, node);
        c[0] += (after > 0 ? 1 : 0) - (before > 0 ? 1 : 0);
        c[1] += (after < 0 ? 1 : 0) - (before < 0 ? 1 : 0);
        dirty_[node / 64] |= std::uint64_t{1} << (node % 64);
        first_dirty_ = std::min(first_dirty_, node / 64);
    }
}

// Operations whose counts changed, terms first.
void LeafFormula::update(std::span<int> row) {
    for (std::size_t w = first_dirty_; w < dirty_.size(); ++w)
        while (dirty_[w] != 0) {
            const std::size_t node = 64 * w + static_cast<std::size_t>(std::countr_zero(dirty_[w]));
            dirty_[w] &= dirty_[w] - 1;
            int* c = counts(row, node);
            const int before = c[2];
            c[2] = value_of(nodes_[node], c[0], c[1]);
            if (c[2] != before) tell_parents(row, nodes_[node].first_parent, before, c[2]);
        }
    first_dirty_ = dirty_.size();
}

void LeafFormula::fill(std::span<int> row) {
    if (!has_table()) count(row);
}

void LeafFormula::count(std::span<int> row) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        int* c = counts(row, i);
        c[0] = nodes_[i].inside;
        c[1] = nodes_[i].unknown;
        c[2] = nodes_[i].value;
    }
    // Terms come first, so nothing has to be updated twice.
    const auto tell = [&](std::int32_t first, int before, int after) {
        for (std::int32_t p = first; p >= 0; p = parents_[static_cast<std::size_t>(p)].next) {
            int* c =
                counts(row, static_cast<std::size_t>(parents_[static_cast<std::size_t>(p)].node));
            c[0] += (after > 0 ? 1 : 0) - (before > 0 ? 1 : 0);
            c[1] += (after < 0 ? 1 : 0) - (before < 0 ? 1 : 0);
        }
    };
    for (std::size_t o = 0; o < operands_; ++o)
        if (const int v = value_of(row[o]); v >= 0) tell(first_parent_[o], -1, v);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        int* c = counts(row, i);
        c[2] = value_of(nodes_[i], c[0], c[1]);
        if (c[2] != nodes_[i].value) tell(nodes_[i].first_parent, nodes_[i].value, c[2]);
    }
}

void LeafFormula::set(std::span<int> row, std::size_t operand, int winding) {
    const int replaced = std::exchange(row[operand], winding);
    if (has_table()) return;
    const int before = value_of(replaced);
    const int after = value_of(winding);
    if (before == after) return;
    tell_parents(row, first_parent_[operand], before, after);
    update(row);
}

int LeafFormula::value(std::span<const int> row) const {
    if (constant_ >= 0) return constant_;
    if (!has_table()) return counted_value(row);
    std::size_t entry = 0;
    for (std::size_t o = 0; o < operands_; ++o)
        entry = 3 * entry + static_cast<std::size_t>(value_of(row[o]) + 1);
    return table_[entry];
}

int LeafFormula::counted_value(std::span<const int> row) const {
    if (root_ < 0) return value_of(row[static_cast<std::size_t>(~root_)]);
    return row[operands_ + 3 * static_cast<std::size_t>(root_) + 2];
}

}  // namespace trisect::detail
