// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/expression.h>

#include <array>
#include <utility>
#include <vector>

#include <trisect/bsp/evaluate/expression_node.h>
#include <trisect/kernel/support/end_graph.h>

namespace trisect {

namespace detail {

ExpressionNode::~ExpressionNode() { end_children(children); }

struct ExpressionAccess {
    static const std::shared_ptr<const ExpressionNode>& root(const Expression& e) {
        // Never destroyed: formulas may be made after main().
        static const auto& empty =
            *new std::shared_ptr<const ExpressionNode>(std::make_shared<ExpressionNode>());
        return e.root_ != nullptr ? e.root_ : empty;
    }
    static Expression make(std::shared_ptr<const ExpressionNode> root) {
        return Expression(std::move(root));
    }
};

const std::shared_ptr<const ExpressionNode>& root_of(const Expression& expression) {
    return ExpressionAccess::root(expression);
}

}  // namespace detail

namespace {

using Kind = detail::ExpressionNode::Kind;

Expression combine(Kind kind, std::span<const Expression> terms) {
    auto n = std::make_shared<detail::ExpressionNode>();
    n->kind = kind;
    n->children.reserve(terms.size());
    for (const Expression& t : terms) n->children.push_back(detail::root_of(t));
    return detail::ExpressionAccess::make(std::move(n));
}

}  // namespace

Expression::Expression(const Solid& solid) {
    auto n = std::make_shared<detail::ExpressionNode>();
    n->solid = solid;
    root_ = std::move(n);
}

Expression operator|(const Expression& a, const Expression& b) {
    return combine(Kind::Or, std::array{a, b});
}
Expression operator&(const Expression& a, const Expression& b) {
    return combine(Kind::And, std::array{a, b});
}
Expression operator-(const Expression& a, const Expression& b) { return a & ~b; }
Expression operator^(const Expression& a, const Expression& b) {
    return combine(Kind::Xor, std::array{a, b});
}
Expression operator~(const Expression& a) { return combine(Kind::Not, std::array{a}); }

Expression Expression::any_of(std::span<const Expression> terms) {
    return combine(Kind::Or, terms);
}
Expression Expression::all_of(std::span<const Expression> terms) {
    return combine(Kind::And, terms);
}
Expression Expression::any_of(std::initializer_list<Expression> terms) {
    return combine(Kind::Or, terms);
}
Expression Expression::all_of(std::initializer_list<Expression> terms) {
    return combine(Kind::And, terms);
}
Expression Expression::any_of(std::span<const Solid> solids) {
    return any_of(std::vector<Expression>(solids.begin(), solids.end()));
}
Expression Expression::all_of(std::span<const Solid> solids) {
    return all_of(std::vector<Expression>(solids.begin(), solids.end()));
}

}  // namespace trisect
