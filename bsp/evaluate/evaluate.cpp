// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/flat_formula.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

using detail::SolidState;

namespace {

using Counters = EvaluateCounters;

constexpr std::array counter_members{
    &Counters::cells,
    &Counters::shared_cells,
    &Counters::constant_cells,
    &Counters::mixed_leaves,
    &Counters::grid_leaves,
    &Counters::filtered_leaves,
    &Counters::filtered_fragments,
    &Counters::prism_leaves,
    &Counters::exact_leaves,
    &Counters::half_space_cuts,
    &Counters::halved_cells,
    &Counters::divided_cells,
    &Counters::embedded_cells,
    &Counters::listed_polygons,
    &Counters::pairs_boxes,
    &Counters::pairs_touching,
    &Counters::pairs_cutting,
    &Counters::doubtful_pairs,
    &Counters::untouched_polygons,
    &Counters::pieces,
    &Counters::linked,
    &Counters::traces,
    &Counters::traces_retried,
    &Counters::traces_near,
    &Counters::traces_within,
    &Counters::cuts_undone,
};
static_assert(sizeof(Counters) == counter_members.size() * sizeof(std::uint64_t));

// Whole space and the empty set are the same on every lattice.
void note_constant(SolidState& state) {
    const auto* const tree = std::get_if<detail::CellTree>(&state.form);
    if (tree == nullptr) return;
    const detail::CellNode& root = *tree->root.node;
    if (!root.is_leaf() || root.deferred() != nullptr || root.size() != 0) return;
    state.lattice_matters = false;
    state.far_out = (root.winding() > 0) != tree->root.complemented ? 1 : 0;
}

}  // namespace

EvaluateCounters& EvaluateCounters::operator+=(const EvaluateCounters& o) {
    for (const auto member : counter_members) this->*member += o.*member;
    return *this;
}

EvaluateCounters& EvaluateCounters::operator-=(const EvaluateCounters& o) {
    for (const auto member : counter_members) this->*member -= o.*member;
    return *this;
}

Solid evaluate(const Expression& expression, const EvaluateOptions& options,
               EvaluateReport* report) {
    const detail::Translation t = detail::translate_without_constants(expression);
    if (auto flat = detail::evaluate_flat(t, options)) {
        if (report != nullptr) *report = {};
        if (report != nullptr) report->lattice.lattice = flat->lattice;
        return detail::solid_of(std::move(flat));
    }
    detail::SolidStates states;
    for (const Solid& s : t.slots) states.push_back(detail::cut_state(s));
    const LatticeReport lattice = detail::move_to_common_lattice(states, options.lattices);
    const bool whole = std::ranges::all_of(states, [](const auto& s) { return s->whole; });
    detail::EvaluateSettings settings{
        options, whole ? detail::SplittingOffset::of_thread() : detail::usual_splitting_offset};
    detail::LimitedEvaluation limited(settings);
    detail::EvaluateStats made;
    std::shared_ptr<SolidState> state;
    for (const detail::Rule& rule : detail::formula_rules())
        if (state == nullptr)
            state = detail::evaluate_by(std::get<detail::FormulaRule>(rule.how), t.formula, states,
                                        settings, made);
    if (state == nullptr) state = detail::evaluate_tree(t.formula, states, settings, made);
    limited.finish(made);
    detail::counters_of_thread<EvaluateCounters> += made;
    state->lattice = lattice.lattice;
    note_constant(*state);
    if (report != nullptr) *report = {lattice, made.memory, made.depth};
    return detail::solid_of(std::move(state));
}

}  // namespace trisect
