// SPDX-License-Identifier: Apache-2.0
//
// Booleans of many prisms along one axis, without a tree.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// Whether a formula is over meshes, each all facets of a source, that may be prisms along one
/// axis, and neither work nor memory is limited.
[[nodiscard]] bool may_be_prisms_of_one_axis(const Residual::Ref& formula,
                                             const SolidStates& solids,
                                             const EvaluateSettings& options);

/// The value of such a formula: PrismOutlines with that tree, or a CellTree of one leaf where all
/// facets are whole. Nothing where these are no prisms. \pre may_be_prisms_of_one_axis()
[[nodiscard]] std::optional<SolidForm> outline_prisms(const Residual::Ref& formula,
                                                      const SolidStates& solids,
                                                      const EvaluateSettings& options,
                                                      EvaluateStats& stats,
                                                      std::shared_ptr<const LazyTree> tree);

}  // namespace trisect::detail
