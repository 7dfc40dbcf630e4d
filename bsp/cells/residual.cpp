// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/residual.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace trisect::detail {

namespace {

using FormulaKind = Residual::Kind;
using Ref = Residual::Ref;

std::uint32_t operations_of(std::span<const Ref> terms) {
    std::uint64_t n = 1;
    for (const Ref& t : terms) n += t->operations;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(n, Residual::many_operations));
}

// Keeps the first of equal terms, or, for an exclusive or, one of an odd number of them.
void drop_repeated(FormulaKind kind, std::vector<Ref>& terms) {
    std::unordered_map<const Residual*, std::size_t> left;
    for (const Ref& t : terms) ++left[t.get()];
    if (left.size() == terms.size()) return;
    if (kind == FormulaKind::Xor)
        for (auto& [term, n] : left) n %= 2;
    std::erase_if(terms, [&](const Ref& t) { return std::exchange(left[t.get()], 0) == 0; });
}

bool has_repeated(std::span<const Ref> terms) {
    for (std::size_t i = 1; i < terms.size(); ++i)
        if (std::find(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(i), terms[i]) !=
            terms.begin() + static_cast<std::ptrdiff_t>(i))
            return true;
    return false;
}

}  // namespace

Residual::Ref Residual::constant(bool value) {
    static const auto make = [](bool v) {
        auto r = std::make_shared<Residual>();
        r->value = v;
        return r;
    };
    // Never destroyed: evaluations may come after main().
    static const Ref& no = *new Ref(make(false));
    static const Ref& yes = *new Ref(make(true));
    return value ? yes : no;
}

Residual::Ref Residual::of_slot(std::int32_t slot) {
    auto r = std::make_shared<Residual>();
    r->kind = FormulaKind::Slot;
    r->slot = slot;
    return r;
}

Residual::Ref Residual::negation(Ref a) {
    if (a->kind == FormulaKind::Constant) return constant(!a->value);
    if (a->kind == FormulaKind::Not) return a->children[0];
    auto r = std::make_shared<Residual>();
    r->kind = FormulaKind::Not;
    r->operations = operations_of({&a, 1});
    r->children.push_back(std::move(a));
    return r;
}

Residual::Ref Residual::of_distinct(FormulaKind kind, std::vector<Ref> terms) {
    if (terms.empty()) return constant(kind == FormulaKind::And);
    if (terms.size() == 1) return terms.front();
    auto n = std::make_shared<Residual>();
    n->kind = kind;
    n->operations = operations_of(terms);
    n->children = std::move(terms);
    return n;
}

Residual::Ref Residual::combination(FormulaKind kind, std::span<const Ref> terms) {
    std::vector<Ref> left;
    bool flip = false;  // constants of an exclusive or
    for (const Ref& t : terms) {
        if (t->kind == FormulaKind::Constant) {
            if (kind == FormulaKind::And && !t->value) return constant(false);
            if (kind == FormulaKind::Or && t->value) return constant(true);
            if (kind == FormulaKind::Xor) flip = flip != t->value;
        } else if (t->kind == kind) {
            left.insert(left.end(), t->children.begin(), t->children.end());
        } else {
            left.push_back(t);
        }
    }
    if (left.size() > 8 || has_repeated(left)) drop_repeated(kind, left);
    const Ref r = of_distinct(kind, std::move(left));
    return flip ? negation(r) : r;
}

namespace {

// Both walks remember inner nodes, if the formula is large.
class Simplifier {
public:
    Simplifier(const Residual& formula, const SlotValues& values)
        : values_(values), remembers_(formula.is_large()) {}

    Ref of(const Ref& formula) {
        if (formula->kind == FormulaKind::Constant) return formula;
        if (formula->kind == FormulaKind::Slot) {
            const auto v = values_[static_cast<std::size_t>(formula->slot)];
            return v < 0 ? formula : Residual::constant(v != 0);
        }
        if (!remembers_) return of_operation(formula);
        if (const auto known = known_.find(formula.get()); known != known_.end())
            return known->second;
        Ref result = with_enough_stack([&] { return of_operation(formula); });
        known_.emplace(formula.get(), result);
        return result;
    }

private:
    Ref of_operation(const Ref& formula) {
        const FormulaKind kind = formula->kind;
        if (kind == FormulaKind::Not) {
            Ref child = of(formula->children[0]);
            return child == formula->children[0] ? formula : Residual::negation(std::move(child));
        }
        std::vector<Ref> children;
        children.reserve(formula->children.size());
        bool changed = false;
        bool distinct = true;  // what is left was there before
        for (const Ref& c : formula->children) {
            children.push_back(of(c));
            if (children.back() == c) continue;
            changed = true;
            if (children.back()->kind != FormulaKind::Constant || kind == FormulaKind::Xor) {
                distinct = false;
            } else if ((kind == FormulaKind::And && !children.back()->value) ||
                       (kind == FormulaKind::Or && children.back()->value)) {
                return children.back();
            }
        }
        if (!changed) return formula;
        if (!distinct) return Residual::combination(kind, children);
        std::erase_if(children, [](const Ref& c) { return c->kind == FormulaKind::Constant; });
        return Residual::of_distinct(kind, std::move(children));
    }

    const SlotValues& values_;
    bool remembers_;
    std::unordered_map<const Residual*, Ref> known_;
};

// Values 0, 1 and, for what is not known, -1.
class Valuer {
public:
    Valuer(const Residual& formula, const SlotValues& values)
        : values_(values), remembers_(formula.is_large()) {}

    int of(const Residual& formula) {
        if (formula.kind == FormulaKind::Constant) return formula.value ? 1 : 0;
        if (formula.kind == FormulaKind::Slot)
            return values_[static_cast<std::size_t>(formula.slot)];
        if (!remembers_) return of_operation(formula);
        if (const auto known = known_.find(&formula); known != known_.end()) return known->second;
        const int result = with_enough_stack([&] { return of_operation(formula); });
        known_.emplace(&formula, result);
        return result;
    }

private:
    int of_operation(const Residual& formula) {
        const auto& cs = formula.children;
        switch (formula.kind) {
            case FormulaKind::Not: {
                const int v = of(*cs[0]);
                return v < 0 ? -1 : 1 - v;
            }
            case FormulaKind::And:
                return of_terms(cs, 0);
            case FormulaKind::Or:
                return of_terms(cs, 1);
            case FormulaKind::Xor: {
                int sum = 0;
                for (const Ref& c : cs) {
                    const int v = of(*c);
                    if (v < 0) return -1;
                    sum ^= v;
                }
                return sum;
            }
            case FormulaKind::Constant:
            case FormulaKind::Slot:
                break;
        }
        return -1;
    }
    // Terms of which one that has the decisive value decides.
    int of_terms(const std::vector<Ref>& terms, int decisive) {
        int result = 1 - decisive;
        for (const Ref& t : terms) {
            const int v = of(*t);
            if (v == decisive) return decisive;
            if (v < 0) result = -1;
        }
        return result;
    }

    const SlotValues& values_;
    bool remembers_;
    std::unordered_map<const Residual*, int> known_;
};

}  // namespace

Residual::Ref simplified(const Residual::Ref& formula, const SlotValues& values) {
    return Simplifier(*formula, values).of(formula);
}

bool value_of(const Residual& formula, const SlotValues& values) {
    return Valuer(formula, values).of(formula) > 0;
}

int bounded_value_of(const Residual& formula, const SlotValues& values) {
    return Valuer(formula, values).of(formula);
}

}  // namespace trisect::detail
