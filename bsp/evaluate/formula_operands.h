// SPDX-License-Identifier: Apache-2.0
//
// FormulaOperands: a formula with its operands on one lattice.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// Evaluates it under the scopes of the calling thread.
class FormulaOperands {
public:
    FormulaOperands(const Translation& t, const EvaluateOptions& options);

    /// By the rules for formulas from this one on; null where none applies.
    [[nodiscard]] std::shared_ptr<SolidState> without_tree(std::size_t first_rule = 0);
    /// Likewise, by the last one.
    [[nodiscard]] std::shared_ptr<SolidState> by_many_meshes();
    [[nodiscard]] std::shared_ptr<SolidState> by_tree();
    /// The solid of a state that one of these has made.
    [[nodiscard]] Solid finish(std::shared_ptr<SolidState> state, EvaluateReport* report) {
        count(made_, report);
        return solid_of_value(std::move(state));
    }

    [[nodiscard]] const Residual::Ref& formula() const { return formula_; }
    [[nodiscard]] const SolidStates& states() const { return states_; }
    [[nodiscard]] const EvaluateSettings& settings() const { return settings_; }
    /// The end of the work. \throw CancelledError, LimitError
    void count(const EvaluateStats& made, EvaluateReport* report);
    /// Of a value of these operands.
    [[nodiscard]] Solid solid_of_value(std::shared_ptr<SolidState> state) const;

private:
    Residual::Ref formula_;
    SolidStates states_;
    LatticeReport lattice_;
    EvaluateSettings settings_;
    LimitedEvaluation limited_;
    EvaluateStats made_;
};

/// Where an operand is named more than once: pair by pair, with copies of it. Nothing where that
/// does not serve, or cells are as fast.
[[nodiscard]] std::optional<Solid> evaluate_of_copies(const Translation& t,
                                                      const EvaluateOptions& options,
                                                      EvaluateReport* report);

/// The value of a formula by the first rule for formulas from `first_rule` on that serves, of
/// copies, or by cells. Prisms over regions are meshes here.
[[nodiscard]] Solid evaluate_translation(const Translation& translation,
                                         const EvaluateOptions& options, EvaluateReport* report,
                                         std::size_t first_rule = 0);

}  // namespace trisect::detail
