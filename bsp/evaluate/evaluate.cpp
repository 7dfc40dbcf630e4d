// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/outlined_solid.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/evaluator.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/two_meshes/undivided_meshes.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

using detail::FacetName;
using detail::SolidState;

namespace {

// What is incomplete in an operand stays so in the result, wherever that shares its leaves. The
// longest list is merged and not sorted again: in a chain that is all but what the last step added.
std::vector<FacetName> all_incomplete(
    std::vector<FacetName> made, const std::vector<std::shared_ptr<const SolidState>>& states) {
    const auto longest = std::ranges::max_element(
        states, {}, [](const auto& state) { return state->incomplete.size(); });
    for (auto s = states.begin(); s != states.end(); ++s)
        if (s != longest) made.insert(made.end(), (*s)->incomplete.begin(), (*s)->incomplete.end());
    std::ranges::sort(made);
    made.erase(std::unique(made.begin(), made.end()), made.end());
    if (longest == states.end() || (*longest)->incomplete.empty()) return made;
    std::vector<FacetName> all;
    all.reserve(made.size() + (*longest)->incomplete.size());
    std::ranges::set_union((*longest)->incomplete, made, std::back_inserter(all));
    return all;
}

// Cells are kept apart from corners and from reference points, which have even coordinates in this
// scale: an even offset could put a splitting plane through one, and so could an offset of a unit
// or more.
void expect_valid(const EvaluateOptions& options) {
    if (options.wall_offset % 2 == 0 || options.wall_offset >= detail::wall_scale)
        throw UsageError("EvaluateOptions::wall_offset: must be odd and below " +
                         std::to_string(detail::wall_scale));
}

}  // namespace

EvaluateStats& EvaluateStats::operator+=(const EvaluateStats& part) {
    cells += part.cells;
    shared_cells += part.shared_cells;
    constant_cells += part.constant_cells;
    mixed_leaves += part.mixed_leaves;
    plain_leaves += part.plain_leaves;
    plain_fragments += part.plain_fragments;
    prism_leaves += part.prism_leaves;
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
    expect_valid(options);
    const detail::Translation t = detail::translate(expression);
    const StopScope scope(options.cancel);  // for what looks at the flag of its thread
    std::vector<std::shared_ptr<const SolidState>> states;
    for (const Solid& s : t.slots) states.push_back(detail::cut_state(s));
    const LatticeReport lattice = detail::move_to_common_lattice(states, options.lattices);
    EvaluateOptions with_flag = options;
    if (options.cancel == nullptr) with_flag.cancel = detail::cancel_of_thread();
    EvaluateStats made;
    auto outlined = detail::outline_prisms(t.formula, states, with_flag, made);
    if (outlined == nullptr)
        outlined = detail::evaluate_undivided(t.formula, states, with_flag, made);
    if (outlined != nullptr) {
        made.lattice = lattice;
        if (stats != nullptr) *stats = made;
        return Solid(std::move(outlined));
    }
    detail::Evaluation evaluation = detail::evaluate_formula(t.formula, states, with_flag);
    auto state = std::make_shared<SolidState>();
    state->lattice = lattice.lattice;
    state->root = std::move(evaluation.root);
    state->embedded = true;
    state->far_out = detail::far_out_of(*t.formula, states);
    state->incomplete = all_incomplete(std::move(evaluation.incomplete), states);
    state->crossings = std::move(evaluation.crossings);
    evaluation.stats.lattice = lattice;
    if (stats != nullptr) *stats = evaluation.stats;
    return Solid(std::shared_ptr<const SolidState>(std::move(state)));
}

}  // namespace trisect
