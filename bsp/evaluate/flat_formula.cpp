// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/flat_formula.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/flat/flat_arrangement.h>
#include <trisect/bsp/flat/flat_outline.h>
#include <trisect/bsp/flat/flat_state.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// Bits that are left free above the largest coordinate.
constexpr double coordinate_room = 0x1p52;

struct FlatTerms {
    std::vector<const FlatPrism*> prisms;
    std::vector<Lattice> lattices;
    SlotValues values;  // of slots that are constant
    std::vector<std::int32_t> slots;
};

bool have_equal_places(const FlatPrism& p, Lattice of_p, const FlatPrism& q, Lattice of_q) {
    return p.axis == q.axis &&
           of_p.to_double(p.low.to_double()) == of_q.to_double(q.low.to_double()) &&
           of_p.to_double(p.high.to_double()) == of_q.to_double(q.high.to_double());
}

// The empty set and whole space are slots as well.
bool add_term(FlatTerms& terms, const SolidState& state) {
    const auto* const prism = std::get_if<FlatPrism>(&state.form);
    if (prism == nullptr) {
        if (state.lattice_matters || state.far_out < 0) return false;
        terms.values.push_back(state.far_out);
        return true;
    }
    if (!terms.prisms.empty() &&
        !have_equal_places(*terms.prisms[0], terms.lattices[0], *prism, state.lattice))
        return false;
    terms.slots.push_back(static_cast<std::int32_t>(terms.values.size()));
    terms.values.push_back(-1);
    terms.prisms.push_back(prism);
    terms.lattices.push_back(state.lattice);
    return true;
}

double largest_of(const FlatPrism& p) {
    return std::max(
        {p.operand->given().largest, std::fabs(p.low.to_double()), std::fabs(p.high.to_double())});
}

// The finest one of all, if everything has room there.
bool find_common_lattice(const FlatTerms& terms, int& exponent) {
    exponent = std::numeric_limits<int>::max();
    for (const Lattice& l : terms.lattices) exponent = std::min(exponent, l.exponent);
    for (std::size_t i = 0; i < terms.prisms.size(); ++i)
        if (std::ldexp(largest_of(*terms.prisms[i]), terms.lattices[i].exponent - exponent) >=
            coordinate_room)
            return false;
    return true;
}

bool is_inside_far_away(const Residual& formula, std::size_t slots) {
    return value_of(formula, SlotValues(slots, 0));
}

}  // namespace

std::shared_ptr<SolidState> evaluate_flat(const Translation& t, const EvaluateOptions& options) {
    FlatTerms terms;
    for (const Solid& s : t.slots)
        if (!add_term(terms, *state_of(s))) return nullptr;
    int exponent = 0;
    if (terms.prisms.empty() || !find_common_lattice(terms, exponent)) return nullptr;
    Residual::Ref formula = t.formula;
    if (terms.slots.size() < t.slots.size()) formula = simplified(formula, terms.values);
    if (is_inside_far_away(*formula, t.slots.size())) return nullptr;
    if (formula->kind == Residual::Kind::Slot) {
        const Solid& only = t.slots[static_cast<std::size_t>(formula->slot)];
        auto same = std::make_shared<SolidState>(*state_of(only));
        if (!std::get<FlatPrism>(same->form).operand->resolved().is_empty()) return same;
    }
    FlatArrangement arrangement;
    for (std::size_t i = 0; i < terms.prisms.size(); ++i)
        arrangement.add(terms.prisms[i]->operand->known(), terms.lattices[i].exponent - exponent);
    arrangement.divide();
    EvaluateSettings settings{options};
    FlatRegion region = flat_outline(arrangement, terms.slots, *formula, settings);
    if (region.is_empty()) return std::make_shared<SolidState>(*state_of(Solid()));
    const bool is_mesh = region.has_corners_only();
    region.lattice = {exponent};
    region.cap_names = terms.prisms[0]->operand->given().cap_names;
    const FlatPrism& first = *terms.prisms[0];
    const auto shifted = [&](Coordinate c) {
        return Coordinate(std::ldexp(c.to_double(), terms.lattices[0].exponent - exponent));
    };
    auto state = flat_state(std::move(region), first.axis, shifted(first.low), shifted(first.high));
    if (!is_mesh)
        std::get<FlatPrism>(state->form).made_of =
            std::make_shared<const FlatPrisms>(FlatPrisms{t.formula, t.slots});
    return state;
}

namespace {

bool is_mesh(const Solid& solid) {
    const auto* const prism = std::get_if<FlatPrism>(&state_of(solid)->form);
    return prism != nullptr && prism->operand->resolved().has_corners_only();
}

bool is_made_of_prisms(const Solid& solid) {
    const auto* const prism = std::get_if<FlatPrism>(&state_of(solid)->form);
    return prism != nullptr && prism->made_of != nullptr;
}

// Slots get new numbers; the same solid has one.
class PrismWriter {
public:
    [[nodiscard]] std::optional<Translation> over_prisms(const Translation& t) {
        std::vector<Residual::Ref> terms;
        for (const Solid& s : t.slots) {
            if (!is_made_of_prisms(s)) {
                terms.push_back(slot_of(s));
                continue;
            }
            const FlatPrisms& made_of = *std::get<FlatPrism>(state_of(s)->form).made_of;
            if (!std::ranges::all_of(made_of.slots, &is_mesh)) return std::nullopt;
            std::vector<Residual::Ref> slots;
            for (const Solid& p : made_of.slots) slots.push_back(slot_of(p));
            terms.push_back(with_terms(*made_of.formula, slots));
        }
        out_.formula = with_terms(*t.formula, terms);
        return std::move(out_);
    }

private:
    Residual::Ref slot_of(const Solid& solid) {
        const auto [at, is_new] =
            numbers_.try_emplace(state_of(solid).get(), static_cast<std::int32_t>(slots_.size()));
        if (is_new) {
            out_.slots.push_back(solid);
            slots_.push_back(Residual::of_slot(at->second));
        }
        return slots_[static_cast<std::size_t>(at->second)];
    }
    static Residual::Ref with_terms(const Residual& f, const std::vector<Residual::Ref>& terms) {
        if (f.kind == Residual::Kind::Constant) return Residual::constant(f.value);
        if (f.kind == Residual::Kind::Slot) return terms[static_cast<std::size_t>(f.slot)];
        std::vector<Residual::Ref> children;
        for (const Residual::Ref& c : f.children)
            children.push_back(with_enough_stack([&] { return with_terms(*c, terms); }));
        return f.kind == Residual::Kind::Not ? Residual::negation(std::move(children[0]))
                                             : Residual::combination(f.kind, children);
    }

    std::unordered_map<const SolidState*, std::int32_t> numbers_;
    std::vector<Residual::Ref> slots_;
    Translation out_;
};

}  // namespace

// A large formula may share parts, and would be written out as a tree.
std::optional<Translation> over_prisms(const Translation& translation) {
    if (translation.formula->operations == Residual::many_operations ||
        std::ranges::none_of(translation.slots, &is_made_of_prisms))
        return std::nullopt;
    return PrismWriter().over_prisms(translation);
}

}  // namespace trisect::detail
