// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>

namespace trisect {

using detail::SolidState;

EvaluateStats& EvaluateStats::operator+=(const EvaluateStats& part) {
    cells += part.cells;
    shared_cells += part.shared_cells;
    constant_cells += part.constant_cells;
    mixed_leaves += part.mixed_leaves;
    grid_leaves += part.grid_leaves;
    filtered_leaves += part.filtered_leaves;
    filtered_fragments += part.filtered_fragments;
    prism_leaves += part.prism_leaves;
    exact_leaves += part.exact_leaves;
    divided_cells += part.divided_cells;
    listed_polygons += part.listed_polygons;
    pairs_boxes += part.pairs_boxes;
    pairs_cutting += part.pairs_cutting;
    pieces += part.pieces;
    traces += part.traces;
    traces_retried += part.traces_retried;
    traces_near += part.traces_near;
    traces_within += part.traces_within;
    pairs_touching += part.pairs_touching;
    untouched_polygons += part.untouched_polygons;
    cuts_undone += part.cuts_undone;
    linked += part.linked;
    memory = std::max(memory, part.memory);
    depth = std::max(depth, part.depth);
    return *this;
}

Solid evaluate(const Expression& expression, const EvaluateOptions& options, EvaluateStats* stats) {
    const detail::Translation t = detail::translate(expression);
    detail::SolidStates states;
    for (const Solid& s : t.slots) states.push_back(detail::cut_state(s));
    const LatticeReport lattice = detail::move_to_common_lattice(states, options.lattices);
    detail::EvaluateSettings settings{options, detail::SplittingOffset::of_thread()};
    detail::LimitedEvaluation limited(settings);
    EvaluateStats made;
    std::shared_ptr<SolidState> state;
    for (const detail::Rule& rule : detail::formula_rules())
        if (state == nullptr)
            state = detail::evaluate_by(std::get<detail::FormulaRule>(rule.how), t.formula, states,
                                        settings, made);
    if (state == nullptr) state = detail::evaluate_tree(t.formula, states, settings, made);
    limited.finish(made);
    state->lattice = lattice.lattice;
    made.lattice = lattice;
    if (stats != nullptr) *stats = made;
    return detail::solid_of(std::move(state));
}

}  // namespace trisect
