// SPDX-License-Identifier: Apache-2.0
//
// Cuts of a mesh by parallel half-spaces, without a tree.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// Whether a formula is one operation on one imported mesh and half-spaces, the mesh alone decides
/// about what is far away, and work is not limited.
[[nodiscard]] bool is_mesh_with_half_spaces(const Residual::Ref& formula, const SolidStates& solids,
                                            const EvaluateSettings& options);

/// The value of such a formula, with that tree. Linear in the mesh. Nothing where planes are not
/// parallel, two are the same, one goes through a corner of the mesh, or none cuts it.
/// \pre is_mesh_with_half_spaces()
[[nodiscard]] std::optional<SolidForm> evaluate_between_half_spaces(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    EvaluateStats& stats, std::shared_ptr<const LazyTree> tree);

}  // namespace trisect::detail
