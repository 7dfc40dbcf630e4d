// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <trisect/bsp/evaluate/disjoint_operands.h>
#include <trisect/bsp/evaluate/flat_formula.h>
#include <trisect/bsp/evaluate/formula_operands.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/operands_in_reach.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>

namespace trisect {

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
    &Counters::conforming_pairs,
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

// The same with what prisms are made of; nothing where no rule for formulas serves.
std::optional<Solid> evaluate_over_prisms(const detail::Translation& t,
                                          const EvaluateOptions& options, EvaluateReport* report) {
    const auto prisms = detail::over_prisms(t);
    if (!prisms) return std::nullopt;
    const auto named = detail::with_named_slots(*prisms);
    detail::FormulaOperands operands(named, options);
    if (auto state = operands.without_tree()) return operands.finish(std::move(state), report);
    return detail::evaluate_of_copies(named, options, report);
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
    const detail::Translation t =
        detail::with_named_slots(detail::translate_without_constants(expression));
    if (auto flat = detail::evaluate_flat(t, options)) {
        if (report != nullptr) *report = {};
        if (report != nullptr) report->lattice.lattice = flat->lattice;
        return detail::solid_of(std::move(flat));
    }
    if (auto solid = evaluate_over_prisms(t, options, report)) return *std::move(solid);
    return detail::evaluate_translation(
        detail::with_operands_in_reach(detail::with_unions_of_disjoint(t)), options, report);
}

}  // namespace trisect
