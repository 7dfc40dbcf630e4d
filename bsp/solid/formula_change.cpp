// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/solid/formula_change.h>

#include <algorithm>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

using Kind = ExpressionNode::Kind;

bool is_same_solid(const Solid& a, const Solid& b) {
    return state_of(a) == state_of(b) || (a.is_empty() && b.is_empty());
}

bool is_same(const ExpressionNode& a, const ExpressionNode& b) {
    if (&a == &b) return true;
    if (a.kind != b.kind || a.children.size() != b.children.size()) return false;
    if (a.kind == Kind::Leaf) return is_same_solid(a.solid, b.solid);
    return with_enough_stack([&] {
        return std::equal(a.children.begin(), a.children.end(), b.children.begin(),
                          [](const auto& x, const auto& y) { return is_same(*x, *y); });
    });
}

bool combined(Kind kind, bool a, bool b) {
    if (kind == Kind::And) return a && b;
    return kind == Kind::Or ? a || b : a != b;
}

}  // namespace

void FormulaChange::compare(const ExpressionNode& before, const ExpressionNode& now) {
    if (!bounded_ || is_same(before, now)) return;
    if (before.kind != now.kind || before.kind == Kind::Leaf) {
        add_all(Kind::Or, {&before}, {&now});
    } else {
        with_enough_stack([&] { compare_terms(before, now); });
    }
}

// As many terms are compared one by one. Else what is the same at both ends is left out, where what
// comes or goes is no condition for all others.
void FormulaChange::compare_terms(const ExpressionNode& before, const ExpressionNode& now) {
    const auto& a = before.children;
    const auto& b = now.children;
    if (a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i) compare(*a[i], *b[i]);
        return;
    }
    std::size_t first = 0;
    std::size_t last = 0;
    if (before.kind != Kind::And) {
        const std::size_t most = std::min(a.size(), b.size());
        while (first < most && is_same(*a[first], *b[first])) ++first;
        while (last < most - first && is_same(*a[a.size() - 1 - last], *b[b.size() - 1 - last]))
            ++last;
    }
    const auto middle = [&](const auto& terms) {
        Nodes out;
        for (std::size_t i = first; i + last < terms.size(); ++i) out.push_back(terms[i].get());
        return out;
    };
    add_all(before.kind, middle(a), middle(b));
}

// Terms of one operation. Beyond their operands they must come to the same.
void FormulaChange::add_all(Kind kind, const Nodes& before, const Nodes& now) {
    const auto value_far_out = [&](const Nodes& terms) {
        bool value = kind == Kind::And;
        for (const ExpressionNode* t : terms) value = combined(kind, value, add(*t));
        return value;
    };
    const bool was = value_far_out(before);
    const bool is = value_far_out(now);
    bounded_ = bounded_ && was == is;
}

// The value beyond all operands.
bool FormulaChange::add(const ExpressionNode& node) {
    if (node.kind == Kind::Leaf) return add_operand(node.solid);
    return with_enough_stack([&] {
        if (node.kind == Kind::Not) return !add(*node.children[0]);
        bool value = node.kind == Kind::And;
        for (const auto& c : node.children) value = combined(node.kind, value, add(*c));
        return value;
    });
}

bool FormulaChange::add_operand(const Solid& solid) {
    ++operands_;
    if (solid.is_empty() || !bounded_) return false;
    try {
        const std::optional<trisect::Bounds> own = bounds(solid);
        if (!own) return true;  // whole space
        if (!box_) box_ = own;
        for (std::size_t k = 0; k < 3; ++k) {
            box_->lo[k] = std::min(box_->lo[k], own->lo[k]);
            box_->hi[k] = std::max(box_->hi[k], own->hi[k]);
        }
    } catch (const UnsupportedError&) {
        bounded_ = false;
    }
    return false;
}

}  // namespace trisect::detail
