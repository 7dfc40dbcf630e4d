// SPDX-License-Identifier: Apache-2.0
//
// ExpressionNode: an operand or an operation of a formula.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

struct ExpressionNode {
    enum class Kind : std::uint8_t { Leaf, Not, And, Or, Xor };

    Kind kind = Kind::Leaf;
    Solid solid;  ///< of a leaf
    std::vector<std::shared_ptr<const ExpressionNode>> children;

    ExpressionNode() = default;
    ExpressionNode(const ExpressionNode&) = delete;
    ExpressionNode& operator=(const ExpressionNode&) = delete;
    ~ExpressionNode();  // iterative: chains may be long
};

/// Never null: a formula that was moved from is that of the empty set.
[[nodiscard]] const std::shared_ptr<const ExpressionNode>& root_of(const Expression& expression);

}  // namespace trisect::detail
