// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/residual.h>

#include <algorithm>

namespace trisect::detail {

Residual::Ref Residual::constant(bool value) {
    static const auto make = [](bool v) {
        auto r = std::make_shared<Residual>();
        r->value = v;
        return r;
    };
    static const Ref no = make(false);
    static const Ref yes = make(true);
    return value ? yes : no;
}

Residual::Ref Residual::of_slot(std::int32_t slot) {
    auto r = std::make_shared<Residual>();
    r->kind = Kind::Slot;
    r->slot = slot;
    return r;
}

Residual::Ref Residual::negation(Ref a) {
    if (a->kind == Kind::Constant) return constant(!a->value);
    if (a->kind == Kind::Not) return a->children[0];
    auto r = std::make_shared<Residual>();
    r->kind = Kind::Not;
    r->children.push_back(std::move(a));
    return r;
}

Residual::Ref Residual::combination(Kind kind, std::span<const Ref> terms) {
    std::vector<Ref> left;
    bool flip = false;  // constants of an exclusive or
    for (const Ref& t : terms) {
        if (t->kind == Kind::Constant) {
            if (kind == Kind::And && !t->value) return constant(false);
            if (kind == Kind::Or && t->value) return constant(true);
            if (kind == Kind::Xor) flip = flip != t->value;
        } else if (t->kind == kind) {
            left.insert(left.end(), t->children.begin(), t->children.end());
        } else {
            left.push_back(t);
        }
    }
    if (left.empty()) return constant(kind == Kind::And ? true : flip);
    Ref r = left.front();
    if (left.size() > 1) {
        auto n = std::make_shared<Residual>();
        n->kind = kind;
        n->children = std::move(left);
        r = n;
    }
    return flip ? negation(r) : r;
}

Residual::Ref simplified(const Residual::Ref& formula, const SlotValues& values) {
    switch (formula->kind) {
        case Residual::Kind::Constant:
            return formula;
        case Residual::Kind::Slot: {
            const auto v = values[static_cast<std::size_t>(formula->slot)];
            return v < 0 ? formula : Residual::constant(v != 0);
        }
        default:
            break;
    }
    std::vector<Residual::Ref> children;
    children.reserve(formula->children.size());
    bool changed = false;
    for (const auto& c : formula->children) {
        children.push_back(simplified(c, values));
        changed = changed || children.back() != c;
        if (children.back()->kind == Residual::Kind::Constant &&
            ((formula->kind == Residual::Kind::And && !children.back()->value) ||
             (formula->kind == Residual::Kind::Or && children.back()->value)))
            return children.back();
    }
    if (!changed) return formula;
    if (formula->kind == Residual::Kind::Not) return Residual::negation(children[0]);
    return Residual::combination(formula->kind, children);
}

bool value_of(const Residual& formula, const SlotValues& values) {
    const auto child = [&](const Residual::Ref& c) { return value_of(*c, values); };
    const auto& cs = formula.children;
    switch (formula.kind) {
        case Residual::Kind::Constant:
            return formula.value;
        case Residual::Kind::Slot:
            return values[static_cast<std::size_t>(formula.slot)] > 0;
        case Residual::Kind::Not:
            return !child(cs[0]);
        case Residual::Kind::And:
            return std::all_of(cs.begin(), cs.end(), child);
        case Residual::Kind::Or:
            return std::any_of(cs.begin(), cs.end(), child);
        case Residual::Kind::Xor:
            return std::count_if(cs.begin(), cs.end(), child) % 2 != 0;
    }
    return false;
}

}  // namespace trisect::detail
