// SPDX-License-Identifier: Apache-2.0
//
// Operations on two meshes of which only triangles may be wanted.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// Whether a formula is a union, an intersection, a difference or an exclusive or of two imported
/// meshes, and work is not limited. Not where one has an index, or is far larger than the other and
/// large, or was compared with such a one before: it gets an index then, and what is beside the
/// smaller one is not looked at. Not where one has fewer than `least_facets` and the other one few,
/// too, so that both are a leaf or two of a tree.
[[nodiscard]] bool are_two_meshes(const Residual::Ref& formula, const SolidStates& solids,
                                  const EvaluateSettings& options, std::size_t least_facets = 16);

/// The value of such a formula, with that tree. Nothing where a pair of facets is not decided, or
/// sides of facets are not known from the pairs. What it returns does not depend on the number of
/// threads. \pre are_two_meshes()
[[nodiscard]] std::optional<SolidForm> evaluate_without_tree(const Residual::Ref& formula,
                                                             const SolidStates& solids,
                                                             const EvaluateSettings& options,
                                                             EvaluateStats& stats,
                                                             std::shared_ptr<const LazyTree> tree);

/// The same for several formulas over the same meshes, in their order: facets are compared once
/// where formulas have their crossings in common. Values are those that each formula has alone,
/// without trees. `shared`, if not null: how often crossings were those of a formula before.
/// \pre are_two_meshes() of each
[[nodiscard]] std::vector<std::optional<UndividedMeshes>> evaluate_all_without_tree(
    std::span<const Residual::Ref> formulas, const SolidStates& solids,
    const EvaluateSettings& options, EvaluateStats& stats, std::size_t* shared);

}  // namespace trisect::detail
