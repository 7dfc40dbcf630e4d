// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/formula_operands.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <variant>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect::detail {

namespace {

// Whole space and the empty set are the same on every lattice.
void note_constant(SolidState& state) {
    const auto* const tree = std::get_if<CellTree>(&state.form);
    if (tree == nullptr) return;
    const CellNode& root = *tree->root.node;
    if (!root.is_leaf() || root.deferred() != nullptr || root.size() != 0) return;
    state.lattice_matters = false;
    state.far_out = (root.winding() > 0) != tree->root.complemented ? 1 : 0;
}

SolidStates cut_states(const Translation& t) {
    SolidStates out;
    for (const Solid& s : t.slots) out.push_back(cut_state(s));
    return out;
}

bool are_whole(const SolidStates& states) {
    return std::ranges::all_of(states, [](const auto& s) { return s->whole; });
}

// Fewer facets are arranged in cells as fast.
constexpr std::size_t least_of_copies = 512;

}  // namespace

FormulaOperands::FormulaOperands(const Translation& t, const EvaluateOptions& options)
    : formula_(t.formula),
      states_(cut_states(t)),
      lattice_(move_to_common_lattice(states_, options.lattices)),
      settings_{options,
                are_whole(states_) ? SplittingOffset::of_thread() : usual_splitting_offset},
      limited_(settings_) {}

std::shared_ptr<SolidState> FormulaOperands::without_tree(std::size_t first_rule) {
    for (const Rule& rule : formula_rules().subspan(first_rule))
        if (auto state =
                evaluate_by(std::get<FormulaRule>(rule.how), formula_, states_, settings_, made_))
            return state;
    return nullptr;
}

std::shared_ptr<SolidState> FormulaOperands::by_many_meshes() {
    const Rule& rule = formula_rules().back();
    return evaluate_by(std::get<FormulaRule>(rule.how), formula_, states_, settings_, made_);
}

std::shared_ptr<SolidState> FormulaOperands::by_tree() {
    return evaluate_tree(formula_, states_, settings_, made_);
}

void FormulaOperands::count(const EvaluateStats& made, EvaluateReport* report) {
    limited_.finish(made);
    counters_of_thread<EvaluateCounters> += made;
    if (report != nullptr) *report = {lattice_, made.memory, made.depth};
}

Solid FormulaOperands::solid_of_value(std::shared_ptr<SolidState> state) const {
    state->lattice = lattice_.lattice;
    note_constant(*state);
    return solid_of(std::move(state));
}

// Copies coincide all over, which costs more in cells.
std::optional<Solid> evaluate_of_copies(const Translation& t, const EvaluateOptions& options,
                                        EvaluateReport* report) {
    std::uint64_t facets = 0;
    for (const Solid& s : t.slots) facets += cut_state(s)->root().node->size();
    if (facets < least_of_copies) return std::nullopt;
    const auto copies = with_copies(t);
    if (!copies) return std::nullopt;
    FormulaOperands operands(*copies, options);
    if (auto state = operands.by_many_meshes()) return operands.finish(std::move(state), report);
    return std::nullopt;
}

Solid evaluate_translation(const Translation& translation, const EvaluateOptions& options,
                           EvaluateReport* report, std::size_t first_rule) {
    FormulaOperands operands(translation, options);
    if (auto state = operands.without_tree(first_rule))
        return operands.finish(std::move(state), report);
    if (auto solid = evaluate_of_copies(translation, options, report)) return *std::move(solid);
    return operands.finish(operands.by_tree(), report);
}

}  // namespace trisect::detail
