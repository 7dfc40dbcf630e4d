// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/straight_crossings.h>

#include <algorithm>

#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

using Kind = Residual::Kind;

// Whether the formula, or its complement, combines operands and complements of operands by one
// operation, and by De Morgan's laws by that one only.
bool is_plain(const Residual& formula, Kind operation) {
    const Kind dual = operation == Kind::And ? Kind::Or : Kind::And;
    if (formula.kind == Kind::Slot || formula.kind == Kind::Constant) return true;
    if (formula.kind != operation && formula.kind != Kind::Not) return false;
    const Kind inner = formula.kind == Kind::Not ? dual : operation;
    return std::ranges::all_of(formula.children, [&](const Residual::Ref& c) {
        return with_enough_stack([&] { return is_plain(*c, inner); });
    });
}

}  // namespace

bool may_have_straight_crossings(const LeafProblem& problem) {
    if (!std::ranges::all_of(problem.operands, &LeafOperand::embedded)) return true;
    // A graph with many paths is not walked as a tree.
    if (problem.formula->operations > 4 * problem.operands.size() + Residual::few_operations)
        return true;
    return !is_plain(*problem.formula, Kind::And) && !is_plain(*problem.formula, Kind::Or);
}

}  // namespace trisect::detail
