// SPDX-License-Identifier: Apache-2.0
//
// Booleans of two large meshes without a tree.
// They serve where only triangles of the result may be wanted.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// A union, an intersection or a difference of two large imported meshes, as an OutlinedSolid: the
/// facets that cross, and the others that bound the result. Null for all else: where meshes do not
/// cross in general position, sides of facets do not follow from that, or work is
/// limited; where one has an index, or is so large beside the other that it gets one: what is
/// beside the smaller one is not looked at then. Meshes of fewer than `least_facets` are divided as
/// quickly. What it returns does not depend on the number of threads.
[[nodiscard]] std::shared_ptr<const SolidState> evaluate_undivided(
    const Residual::Ref& formula, const std::vector<std::shared_ptr<const SolidState>>& solids,
    const EvaluateOptions& options, EvaluateStats& stats, std::size_t least_facets = 1024);

}  // namespace trisect::detail
