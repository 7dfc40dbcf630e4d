// SPDX-License-Identifier: Apache-2.0
#include "expression.h"

#include <utility>

namespace reference {
namespace {

void print(const Expression& expression, std::string& out) {
    using Kind = Expression::Kind;
    if (expression.kind == Kind::Leaf) {
        out += std::to_string(expression.operand);
        return;
    }
    if (expression.kind == Kind::Complement) {
        out += '~';
        print(expression.children.at(0), out);
        return;
    }
    const char* const sign = expression.kind == Kind::Union          ? " + "
                             : expression.kind == Kind::Intersection ? " * "
                             : expression.kind == Kind::Difference   ? " - "
                                                                     : " ^ ";
    out += '(';
    for (std::size_t i = 0; i < expression.children.size(); ++i) {
        out += i == 0 ? "" : sign;
        print(expression.children[i], out);
    }
    out += ')';
}

}  // namespace

Expression pair_expression(Expression::Kind kind) {
    return Expression::node(kind, {Expression::leaf(0), Expression::leaf(1)});
}

bool holds(const Expression& expression, const std::vector<bool>& memberships) {
    using Kind = Expression::Kind;
    if (expression.kind == Kind::Leaf) {
        return memberships.at(expression.operand);
    }
    bool value = holds(expression.children.at(0), memberships);
    if (expression.kind == Kind::Complement) {
        return !value;
    }
    for (std::size_t i = 1; i < expression.children.size(); ++i) {
        const bool other = holds(expression.children[i], memberships);
        switch (expression.kind) {
            case Kind::Union:
                value = value || other;
                break;
            case Kind::Intersection:
                value = value && other;
                break;
            case Kind::Difference:
                value = value && !other;
                break;
            default:
                value = value != other;
                break;
        }
    }
    return value;
}

std::string to_string(const Expression& expression) {
    std::string out;
    print(expression, out);
    return out;
}

Indicator make_indicator(Expression expression, InsideRule rule) {
    return [expression = std::move(expression), rule](const std::vector<int>& windings) {
        std::vector<bool> memberships;
        for (const int winding : windings) {
            memberships.push_back(rule == InsideRule::Positive ? winding > 0 : winding != 0);
        }
        return holds(expression, memberships);
    };
}

}  // namespace reference
