// SPDX-License-Identifier: Apache-2.0
//
// Set expressions over operands, for the naive engine.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace reference {

enum class InsideRule { Positive, NonZero };

// A set expression over operands. Union, Intersection and Xor take one child or more, Difference
// subtracts all further children from the first, Complement takes one.
struct Expression {
    enum class Kind { Leaf, Union, Intersection, Difference, Xor, Complement };

    Kind kind = Kind::Leaf;
    std::size_t operand = 0;  // of a leaf
    std::vector<Expression> children;

    static Expression leaf(std::size_t operand) { return {Kind::Leaf, operand, {}}; }
    static Expression node(Kind kind, std::vector<Expression> children) {
        return {kind, 0, std::move(children)};
    }
};

// For two operands: operand 0 kind operand 1.
Expression pair_expression(Expression::Kind kind);

// Value of the expression for a point whose membership of each operand is given.
bool holds(const Expression& expression, const std::vector<bool>& memberships);

// For messages, e.g. "((0 + 1) - ~2)": + union, * intersection, - difference, ^ xor, ~ complement.
std::string to_string(const Expression& expression);

// Whether a point with these winding numbers, one per operand, is in the set.
using Indicator = std::function<bool(const std::vector<int>& windings)>;

Indicator make_indicator(Expression expression, InsideRule rule = InsideRule::Positive);

}  // namespace reference
