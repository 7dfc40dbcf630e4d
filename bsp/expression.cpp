// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/expression.h>

#include <array>
#include <utility>

#include <trisect/kernel/support/end_graph.h>

namespace trisect {

Expression::Node::~Node() { detail::end_children(children); }

Expression::Expression(const Solid& solid) {
    auto n = std::make_shared<Node>();
    n->solid = solid;
    root_ = std::move(n);
}

const std::shared_ptr<const Expression::Node>& Expression::empty_root() {
    // Never destroyed: formulas may be made after main().
    static const auto& empty = *new std::shared_ptr<const Node>(std::make_shared<Node>());
    return empty;
}

Expression Expression::combine(Kind kind, std::span<const Expression> terms) {
    auto n = std::make_shared<Node>();
    n->kind = kind;
    n->children.reserve(terms.size());
    for (const Expression& t : terms) n->children.push_back(t.root());
    return Expression(std::shared_ptr<const Node>(std::move(n)));
}

Expression operator|(const Expression& a, const Expression& b) {
    return Expression::combine(Expression::Kind::Or, std::array{a, b});
}
Expression operator&(const Expression& a, const Expression& b) {
    return Expression::combine(Expression::Kind::And, std::array{a, b});
}
Expression operator-(const Expression& a, const Expression& b) { return a & ~b; }
Expression operator^(const Expression& a, const Expression& b) {
    return Expression::combine(Expression::Kind::Xor, std::array{a, b});
}
Expression operator~(const Expression& a) {
    return Expression::combine(Expression::Kind::Not, std::array{a});
}

Expression Expression::any_of(std::span<const Expression> terms) {
    return combine(Kind::Or, terms);
}
Expression Expression::all_of(std::span<const Expression> terms) {
    return combine(Kind::And, terms);
}

}  // namespace trisect
