// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate_all.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/formula_operands.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

using detail::Translation;

// The rules for formulas after those for prisms and for two meshes.
constexpr std::size_t rules_after_two_meshes = 2;

// Whether the formulas name the same solids in the same order.
bool have_same_slots(const Translation& a, const Translation& b) {
    return std::ranges::equal(a.slots, b.slots, [](const Solid& s, const Solid& t) {
        return detail::state_of(s) == detail::state_of(t);
    });
}

// Whether they may be evaluated together: two meshes as they were imported.
bool are_imported_meshes(const Translation& t) {
    detail::SolidStates states;
    for (const Solid& s : t.slots) states.push_back(detail::state_of(s));
    return states.size() == 2 &&
           std::ranges::all_of(
               states,
               [](const auto& s) { return std::holds_alternative<detail::CellTree>(s->form); }) &&
           detail::crossing_operands(states).has_value();
}

class TogetherEvaluated {
public:
    TogetherEvaluated(std::span<const Expression> formulas, const EvaluateOptions& options)
        : formulas_(formulas),
          options_(options),
          solids_(formulas.size()),
          reports_(formulas.size()),
          is_tried_(formulas.size()) {
        for (const Expression& e : formulas)
            translations_.push_back(
                detail::with_named_slots(detail::translate_without_constants(e)));
    }

    [[nodiscard]] std::vector<Solid> run(std::vector<EvaluateReport>* reports) {
        for (std::size_t i = 0; i < formulas_.size(); ++i) {
            if (solids_[i]) continue;
            if (!is_tried_[i]) evaluate_with_those_after(i);
            if (!solids_[i]) evaluate_alone(i);
        }
        counters_.results = formulas_.size();
        detail::counters_of_thread<EvaluateAllCounters> += counters_;
        if (reports != nullptr) *reports = std::move(reports_);
        std::vector<Solid> out;
        for (auto& solid : solids_) out.push_back(*std::move(solid));
        return out;
    }

private:
    void evaluate_alone(std::size_t i) {
        ++counters_.evaluations;
        solids_[i] = is_tried_[i]
                         ? detail::evaluate_translation(translations_[i], options_, &reports_[i],
                                                        rules_after_two_meshes)
                         : evaluate(formulas_[i], options_, &reports_[i]);
    }

    void evaluate_with_those_after(std::size_t first) {
        const Translation& t = translations_[first];
        if (!are_imported_meshes(t)) return;
        std::vector<std::size_t> same;
        for (std::size_t i = first; i < formulas_.size(); ++i)
            if (!solids_[i] && !is_tried_[i] && have_same_slots(t, translations_[i]))
                same.push_back(i);
        if (same.size() < 2) return;
        detail::FormulaOperands operands(t, options_);
        std::erase_if(same, [&](std::size_t i) {
            return !detail::are_two_meshes(translations_[i].formula, operands.states(),
                                           operands.settings()) ||
                   detail::are_one_grid(operands.states(), operands.settings());
        });
        if (same.size() >= 2 && !outline_first(first, operands)) evaluate_together(same, operands);
    }

    // Where two meshes are prisms to outline: then so are those of the other formulas.
    [[nodiscard]] bool outline_first(std::size_t first, detail::FormulaOperands& operands) {
        detail::EvaluateStats made;
        auto state = detail::evaluate_by(detail::rule_of_prisms(), translations_[first].formula,
                                         operands.states(), operands.settings(), made);
        if (!state) return false;
        operands.count(made, &reports_[first]);
        solids_[first] = operands.solid_of_value(std::move(state));
        ++counters_.evaluations;
        return true;
    }

    void evaluate_together(std::span<const std::size_t> same, detail::FormulaOperands& operands) {
        std::vector<detail::Residual::Ref> formulas;
        for (const std::size_t i : same) {
            formulas.push_back(translations_[i].formula);
            is_tried_[i] = true;
        }
        detail::EvaluateStats made;
        std::size_t shared = 0;
        auto forms = detail::evaluate_all_without_tree(formulas, operands.states(),
                                                       operands.settings(), made, &shared);
        EvaluateReport report;
        operands.count(made, &report);
        for (std::size_t k = 0; k < same.size(); ++k) {
            if (!forms[k]) continue;
            forms[k]->tree =
                detail::lazy_tree_of(formulas[k], operands.states(), operands.settings());
            solids_[same[k]] = operands.solid_of_value(detail::state_of_value(
                *std::move(forms[k]), *formulas[k], operands.states(), operands.settings()));
            reports_[same[k]] = report;
            ++counters_.evaluations;
        }
        counters_.evaluations -= shared;
    }

    std::span<const Expression> formulas_;
    const EvaluateOptions& options_;
    std::vector<Translation> translations_;
    std::vector<std::optional<Solid>> solids_;
    std::vector<EvaluateReport> reports_;
    std::vector<bool> is_tried_;  // by the rule for two meshes
    EvaluateAllCounters counters_;
};

}  // namespace

std::vector<Solid> evaluate_all(std::span<const Expression> formulas,
                                const EvaluateOptions& options,
                                std::vector<EvaluateReport>* reports) {
    return TogetherEvaluated(formulas, options).run(reports);
}

}  // namespace trisect
