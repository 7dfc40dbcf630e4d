// SPDX-License-Identifier: Apache-2.0
//
// Exclusive ors of many meshes of which only triangles may be wanted.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>

namespace trisect::detail {

/// Whether a formula is an exclusive or of three imported meshes or more, or of complements of
/// some, none of which has an index, and neither work nor memory is limited.
[[nodiscard]] bool is_exclusive_or_of_many(const Residual::Ref& formula, const SolidStates& solids,
                                           const EvaluateSettings& options);

/// The value of such a formula, with that tree. Nothing where sides are not known, nor where meshes
/// touch: faces of more than two planes through one line may cross there, without an edge in the
/// line. What it returns does not depend on the number of threads. \pre is_exclusive_or_of_many()
[[nodiscard]] std::optional<SolidForm> evaluate_exclusive_or_without_tree(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    EvaluateStats& stats, std::shared_ptr<const LazyTree> tree);
/// The same where meshes touch, too: for tests.
[[nodiscard]] std::optional<SolidForm> evaluate_touching_exclusive_or(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    EvaluateStats& stats, std::shared_ptr<const LazyTree> tree);

}  // namespace trisect::detail
