// SPDX-License-Identifier: Apache-2.0
//
// Table of rules for formulas and cells, in the order of trial.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/evaluate/arranger_pool.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>

namespace trisect::detail {

/// The arguments of a condition.
struct CellView {
    const CellTask& task;
    const EvaluateSettings& options;
    SlotValues& values;        ///< scratch, all unknown
    bool collects = false;     ///< crossings
    bool undividable = false;  ///< splitters do not part the polygons any more
    std::uint64_t size = 0;    ///< polygons

    [[nodiscard]] bool is_small() const { return undividable || size <= options.leaf_polygons; }
};

/// What the evaluator does with a cell beside arranging its polygons. A step returns nothing, with
/// the same set left to be evaluated, when it does not serve the cell after all.
class CellSteps {
public:
    [[nodiscard]] virtual std::optional<CellRef> make_constant(CellTask& task) = 0;
    [[nodiscard]] virtual std::optional<CellRef> share(CellTask& task) = 0;
    [[nodiscard]] virtual std::optional<CellRef> halve(CellTask& task) = 0;
    [[nodiscard]] virtual std::optional<CellRef> divide(CellTask& task) = 0;

protected:
    CellSteps() = default;
    ~CellSteps() = default;
};

/// Evaluates a whole formula without a tree.
struct FormulaRule {
    bool (*applies)(const Residual::Ref& formula, const SolidStates& solids,
                    const EvaluateSettings& options);
    /// Nothing when the operands are of another kind after all. `tree`: of the result.
    /// \pre applies()
    std::optional<SolidForm> (*evaluate)(const Residual::Ref& formula, const SolidStates& solids,
                                         const EvaluateSettings& options, EvaluateStats& stats,
                                         std::shared_ptr<const LazyTree> tree);
};

/// Resolves or divides a cell as a whole.
struct CellRule {
    bool (*applies)(const CellView& view);
    std::optional<CellRef> (CellSteps::*take)(CellTask& task);
};

/// Arranges the polygons of a cell.
struct LeafRule {
    std::uint32_t reach;  ///< up to so many times EvaluateOptions::leaf_polygons
    bool (*applies)(const CellView& view);
    LeafArrangement& (*arrangement)(LeafArrangers& arrangers);

    [[nodiscard]] bool may_serve(const CellView& view) const {
        return (view.undividable ||
                view.size <= std::uint64_t{reach} * view.options.leaf_polygons) &&
               applies(view);
    }
};

/// A row of the table. Of the rows that apply the first one that serves is taken. Texts are those
/// of docs/booleans.md.
struct Rule {
    std::string_view name;
    std::string_view condition;
    std::string_view keeps;
    std::uint64_t EvaluateCounters::*counter;  ///< cells that it resolved
    std::variant<FormulaRule, CellRule, LeafRule> how;
};

/// All rows.
[[nodiscard]] std::span<const Rule> rules();
/// Those for whole formulas; the others are for cells.
[[nodiscard]] std::span<const Rule> formula_rules();
/// The first one.
[[nodiscard]] const FormulaRule& rule_of_prisms();
/// Those of cells that are decided by the formula alone.
[[nodiscard]] std::span<const Rule> constant_rules();
/// Those of cells that depend on the polygons. The last one that is not for small cells alone
/// divides; where it does not serve, the cell is undividable, and these are walked once more.
[[nodiscard]] std::span<const Rule> polygon_rules();

/// Of two imported meshes that are not apart: whether one leaf has all facets, which are all across
/// the axes. Then a grid of bits is faster than crossings.
[[nodiscard]] bool are_one_grid(const SolidStates& solids, const EvaluateSettings& options);

/// The state of a formula's value in some form. `solids`: as below.
[[nodiscard]] std::shared_ptr<SolidState> state_of_value(SolidForm form, const Residual& formula,
                                                         const SolidStates& solids,
                                                         const EvaluateSettings& options);
/// The tree of a formula's value, by the rules for cells.
[[nodiscard]] std::shared_ptr<const LazyTree> lazy_tree_of(const Residual::Ref& formula,
                                                           const SolidStates& solids,
                                                           const EvaluateSettings& options);

/// The value of a formula by one rule; null where that does not apply or serve. `solids` are
/// trees and lie on one lattice.
[[nodiscard]] std::shared_ptr<SolidState> evaluate_by(const FormulaRule& rule,
                                                      const Residual::Ref& formula,
                                                      const SolidStates& solids,
                                                      const EvaluateSettings& options,
                                                      EvaluateStats& stats);
/// The same by the rules for cells, as a tree.
[[nodiscard]] std::shared_ptr<SolidState> evaluate_tree(const Residual::Ref& formula,
                                                        const SolidStates& solids,
                                                        const EvaluateSettings& options,
                                                        EvaluateStats& stats);

/// DeferredLeaf::arrange by the first rule that serves, whatever the number of polygons. It starts
/// from the beginning, which takes no longer than the cutting itself.
[[nodiscard]] PolygonList arrange_deferred(const DeferredLeaf& leaf);

/// The formula over its only slot.
struct ValuesOfOne {
    bool outside = false;  ///< its value outside of the operand
    bool inside = false;
};
[[nodiscard]] ValuesOfOne values_of_one(const Residual& formula, std::int32_t slot,
                                        SlotValues& values);

/// Whether splitting planes have divided the polygons so badly, or so often, that none is tried any
/// more.
[[nodiscard]] bool splitters_have_failed(const CellTask& task);
/// CellTask::stalled for the two sides of a splitter, which have so many polygons.
[[nodiscard]] int stalled_after(const CellTask& task, std::uint64_t first, std::uint64_t second);

}  // namespace trisect::detail
