// SPDX-License-Identifier: Apache-2.0
//
// Evaluator: evaluation of one boolean formula over cell trees.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

struct Evaluation {
    CellRef root;
    /// Facets that lost a part to a coincident one (SolidState::incomplete); unordered.
    std::vector<FacetName> incomplete;
    std::shared_ptr<const Crossings> crossings;  ///< as in SolidState
    EvaluateStats stats;
};

/// The tree of a formula's value. `solids` are its slots and lie on one lattice.
[[nodiscard]] Evaluation evaluate_formula(const Residual::Ref& formula,
                                          std::span<const std::shared_ptr<const SolidState>> solids,
                                          const EvaluateOptions& options);

}  // namespace trisect::detail
