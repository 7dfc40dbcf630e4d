// SPDX-License-Identifier: Apache-2.0
//
// Evaluator: evaluation of one boolean formula over cell trees.
#pragma once

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

struct Evaluation {
    CellTree tree;
    EvaluateStats stats;
};

/// The tree of a formula's value. `solids` are its slots and lie on one lattice. With a cell, the
/// tree of that cell: then the solids' roots are leaves of it with one reference point.
[[nodiscard]] Evaluation evaluate_formula(const Residual::Ref& formula, const SolidStates& solids,
                                          const EvaluateSettings& options,
                                          const Cell* cell = nullptr);

}  // namespace trisect::detail
