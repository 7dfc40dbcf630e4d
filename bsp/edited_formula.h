// SPDX-License-Identifier: Apache-2.0
//
// EditedFormula: a formula that is evaluated again after each change.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// What an evaluation had to do.
struct ChangeReport {
    std::size_t changed_operands = 0;  ///< of the last formula and of this one
    /// Around these. Nothing where no operand changed, or all was evaluated.
    std::optional<Bounds> box;
    bool evaluated_all = false;
};

/// Keeps the last formula and its set. Of the next formula only what lies in the box around the
/// operands that changed is evaluated, in the cells of the last set's tree; all other cells are
/// shared with it. So an edit costs what it changes, and a pass over the operands' facets.
///
/// Operands are the same where they are copies of one Solid. Formulas are compared term by term: a
/// term may be replaced, and terms of unions may come and go. All is evaluated in the beginning,
/// where an unbounded operand changed, where what is far away changed, and where the operands need
/// a finer lattice, or are or were rounded to one. Sets have trees at once, which for formulas that
/// evaluate() need not cut into cells takes longer than that.
///
/// A set of an earlier formula stays what it is. Not to be used by several threads at once.
class EditedFormula {
public:
    explicit EditedFormula(const EvaluateOptions& options = {});
    EditedFormula(EditedFormula&&) noexcept;
    EditedFormula& operator=(EditedFormula&&) noexcept;
    ~EditedFormula();

    /// The set that the formula describes, the same as of evaluate(). \throw as evaluate(); then
    /// the last formula is kept
    Solid evaluate(const Expression& formula, ChangeReport* report = nullptr);

private:
    struct Last;
    EvaluateOptions options_;
    std::unique_ptr<Last> last_;
};

}  // namespace trisect
