// SPDX-License-Identifier: Apache-2.0
//
// The new formula and the last set are operands of one formula, with a term that says which of them
// counts: (new and window) or (last and not window). The window is nothing that has a boundary; the
// evaluator gives it a value for each cell, once the cell lies beside the box of what changed or is
// a leaf of the last set's tree.
//
// Facets are the same only where their sources are. Moving an operand to another lattice makes a
// source anew, so operands are kept as they were moved.

#include <trisect/bsp/edited_formula.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/changed_box.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/solid/formula_change.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

using detail::SolidState;
using detail::SolidStates;
using State = std::shared_ptr<const SolidState>;

// The lattice positions around a box, and one more on all sides.
detail::Box lattice_box(const Bounds& bounds, const Lattice& lattice) {
    const double unit = lattice.to_double(1);
    const auto limited = [](double units) {
        constexpr auto limit = static_cast<double>(coordinate_limit);
        return static_cast<std::int64_t>(std::clamp(units, -limit, limit));
    };
    detail::Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = limited(std::floor(bounds.lo[k] / unit) - 1);
        box.hi[k] = limited(std::ceil(bounds.hi[k] / unit) + 1);
    }
    return box;
}

State evaluated(const detail::Residual::Ref& formula, const SolidStates& states,
                const LatticeReport& lattice, const detail::ChangedBox* change,
                const EvaluateOptions& options) {
    const bool whole = std::ranges::all_of(states, [](const auto& s) { return s->whole; });
    detail::EvaluateSettings settings{
        options, whole ? detail::SplittingOffset::of_thread() : detail::usual_splitting_offset};
    settings.change = change;
    detail::LimitedEvaluation limited(settings);
    detail::EvaluateStats made;
    auto state = detail::evaluate_tree(formula, states, settings, made);
    limited.finish(made);
    detail::counters_of_thread<EvaluateCounters> += made;
    state->lattice = lattice.lattice;
    return state;
}

std::int32_t slot_of(const std::vector<Solid>& slots, const State& state) {
    const auto at =
        std::ranges::find(slots, state, [](const Solid& s) { return detail::state_of(s); });
    return static_cast<std::int32_t>(at - slots.begin());
}

}  // namespace

struct EditedFormula::Last {
    Expression formula;
    Solid solid;
    LatticeReport lattice;
    // Operands as they were given, which keeps them, and on the lattice.
    std::map<State, State> moved;

    explicit Last(const Expression& f) : formula(f), solid(Solid()) {}

    static std::unique_ptr<Last> all_of(const Expression& formula, const EvaluateOptions& options);
    [[nodiscard]] std::unique_ptr<Last> next(const Expression& formula, const Bounds& box,
                                             const EvaluateOptions& options) const;
    void keep(const std::vector<Solid>& slots, const SolidStates& states);
};

void EditedFormula::Last::keep(const std::vector<Solid>& slots, const SolidStates& states) {
    for (std::size_t i = 0; i < slots.size(); ++i)
        moved.emplace(detail::state_of(slots[i]), states[i]);
}

std::unique_ptr<EditedFormula::Last> EditedFormula::Last::all_of(const Expression& formula,
                                                                 const EvaluateOptions& options) {
    auto out = std::make_unique<Last>(formula);
    const detail::Translation t = detail::translate(formula);
    SolidStates states;
    for (const Solid& s : t.slots) states.push_back(detail::cut_state(s));
    out->lattice = detail::move_to_common_lattice(states, options.lattices);
    out->solid = detail::solid_of(evaluated(t.formula, states, out->lattice, nullptr, options));
    out->keep(t.slots, states);
    return out;
}

// Null where something is on another lattice then, or is rounded: alone it may not be.
std::unique_ptr<EditedFormula::Last> EditedFormula::Last::next(
    const Expression& f, const Bounds& box, const EvaluateOptions& options) const {
    const Solid window = detail::solid_of(std::make_shared<SolidState>(*detail::state_of(Solid())));
    const detail::Translation t = detail::translate((f & window) | (solid - window));
    SolidStates states;
    std::vector<bool> stays;
    for (const Solid& s : t.slots) {
        const auto known = moved.find(detail::state_of(s));
        states.push_back(known != moved.end() ? known->second : detail::cut_state(s));
        stays.push_back(known != moved.end() || detail::state_of(s) == detail::state_of(solid));
    }
    auto out = std::make_unique<Last>(f);
    const SolidStates given = states;
    out->lattice = detail::move_to_common_lattice(states, options.lattices);
    if (!lattice.lossless || !out->lattice.lossless) return nullptr;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (stays[i] && states[i] != given[i]) return nullptr;
    const detail::ChangedBox change{slot_of(t.slots, detail::state_of(window)),
                                    slot_of(t.slots, detail::state_of(solid)),
                                    lattice_box(box, out->lattice.lattice)};
    auto state =
        std::make_shared<SolidState>(*evaluated(t.formula, states, out->lattice, &change, options));
    state->far_out = detail::state_of(solid)->far_out;
    out->solid = detail::solid_of(std::move(state));
    out->keep(t.slots, states);
    out->moved.erase(detail::state_of(solid));
    out->moved.erase(detail::state_of(window));
    return out;
}

EditedFormula::EditedFormula(const EvaluateOptions& options) : options_(options) {}
EditedFormula::EditedFormula(EditedFormula&&) noexcept = default;
EditedFormula& EditedFormula::operator=(EditedFormula&&) noexcept = default;
EditedFormula::~EditedFormula() = default;

Solid EditedFormula::evaluate(const Expression& formula, ChangeReport* report) {
    ChangeReport done;
    std::unique_ptr<Last> next;
    if (last_ != nullptr) {
        const detail::FormulaChange change(*detail::root_of(last_->formula),
                                           *detail::root_of(formula));
        done.changed_operands = change.operand_count();
        const bool bounded = change.is_bounded() && detail::state_of(last_->solid)->far_out >= 0;
        if (bounded) done.box = change.box();
        if (bounded && done.box) next = last_->next(formula, *done.box, options_);
        if (bounded && !done.box) {
            next = std::make_unique<Last>(*last_);
            next->formula = formula;
        }
    }
    if (next == nullptr) {
        done.evaluated_all = true;
        done.box.reset();
        next = Last::all_of(formula, options_);
    }
    last_ = std::move(next);
    if (report != nullptr) *report = done;
    return last_->solid;
}

}  // namespace trisect
