// SPDX-License-Identifier: Apache-2.0
//
// FormulaChange: the operands in which two formulas differ.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/bsp/evaluate/expression_node.h>

namespace trisect::detail {

/// Outside of the boxes of the operands listed both formulas have the same value, or the change is
/// not bounded.
class FormulaChange {
public:
    FormulaChange(const ExpressionNode& before, const ExpressionNode& now) { compare(before, now); }
    /// False where all of space may differ.
    [[nodiscard]] bool is_bounded() const { return bounded_; }
    [[nodiscard]] std::size_t operand_count() const { return operands_; }
    /// Around all of them; nothing where the formulas are the same, or the operands are empty.
    [[nodiscard]] const std::optional<trisect::Bounds>& box() const { return box_; }

private:
    using Nodes = std::vector<const ExpressionNode*>;

    void compare(const ExpressionNode& before, const ExpressionNode& now);
    void compare_terms(const ExpressionNode& before, const ExpressionNode& now);
    void add_all(ExpressionNode::Kind kind, const Nodes& before, const Nodes& now);
    [[nodiscard]] bool add(const ExpressionNode& node);
    [[nodiscard]] bool add_operand(const Solid& solid);

    bool bounded_ = true;
    std::size_t operands_ = 0;
    std::optional<trisect::Bounds> box_;
};

}  // namespace trisect::detail
