// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/flat_formula.h>
#include <trisect/bsp/evaluate/named_slots.h>
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

// A formula with its operands on one lattice.
class Operands {
public:
    Operands(const detail::Translation& t, const EvaluateOptions& options)
        : formula_(t.formula),
          states_(cut_states(t)),
          lattice_(detail::move_to_common_lattice(states_, options.lattices)),
          settings_{options, are_whole() ? detail::SplittingOffset::of_thread()
                                         : detail::usual_splitting_offset},
          limited_(settings_) {}

    /// Null where no rule for formulas applies.
    [[nodiscard]] std::shared_ptr<SolidState> without_tree() {
        for (const detail::Rule& rule : detail::formula_rules())
            if (auto state = detail::evaluate_by(std::get<detail::FormulaRule>(rule.how), formula_,
                                                 states_, settings_, made_))
                return state;
        return nullptr;
    }
    /// Likewise.
    [[nodiscard]] std::shared_ptr<SolidState> by_many_meshes() {
        const detail::Rule& rule = detail::formula_rules().back();
        return detail::evaluate_by(std::get<detail::FormulaRule>(rule.how), formula_, states_,
                                   settings_, made_);
    }
    [[nodiscard]] std::shared_ptr<SolidState> by_tree() {
        return detail::evaluate_tree(formula_, states_, settings_, made_);
    }
    [[nodiscard]] Solid finish(std::shared_ptr<SolidState> state, EvaluateReport* report) {
        limited_.finish(made_);
        detail::counters_of_thread<EvaluateCounters> += made_;
        state->lattice = lattice_.lattice;
        note_constant(*state);
        if (report != nullptr) *report = {lattice_, made_.memory, made_.depth};
        return detail::solid_of(std::move(state));
    }

private:
    static detail::SolidStates cut_states(const detail::Translation& t) {
        detail::SolidStates out;
        for (const Solid& s : t.slots) out.push_back(detail::cut_state(s));
        return out;
    }
    [[nodiscard]] bool are_whole() const {
        return std::ranges::all_of(states_, [](const auto& s) { return s->whole; });
    }

    detail::Residual::Ref formula_;
    detail::SolidStates states_;
    LatticeReport lattice_;
    detail::EvaluateSettings settings_;
    detail::LimitedEvaluation limited_;
    detail::EvaluateStats made_;
};

// Fewer facets are arranged in cells as fast.
constexpr std::size_t least_of_copies = 512;

// Where an operand is named more than once: pair by pair, with copies of it. They coincide all
// over, which costs more in cells.
std::optional<Solid> of_copies(const detail::Translation& t, const EvaluateOptions& options,
                               EvaluateReport* report) {
    std::uint64_t facets = 0;
    for (const Solid& s : t.slots) facets += detail::cut_state(s)->root().node->size();
    if (facets < least_of_copies) return std::nullopt;
    const auto copies = detail::with_copies(t);
    if (!copies) return std::nullopt;
    Operands operands(*copies, options);
    if (auto state = operands.by_many_meshes()) return operands.finish(std::move(state), report);
    return std::nullopt;
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
    if (const auto prisms = detail::over_prisms(t)) {
        const auto named = detail::with_named_slots(*prisms);
        Operands operands(named, options);
        if (auto state = operands.without_tree()) return operands.finish(std::move(state), report);
        if (auto solid = of_copies(named, options, report)) return *std::move(solid);
    }
    Operands operands(t, options);
    if (auto state = operands.without_tree()) return operands.finish(std::move(state), report);
    if (auto solid = of_copies(t, options, report)) return *std::move(solid);
    return operands.finish(operands.by_tree(), report);
}

}  // namespace trisect
