// SPDX-License-Identifier: Apache-2.0
//
// Straight crossings: lines in which faces of a result cross each other.
#pragma once

#include <trisect/bsp/cells/leaf_problem.h>

namespace trisect::detail {

/// Whether facets that the leaf does not cut along a line may go straight across each other there.
/// That takes three planes through the line, and a formula in which the operands' sides of a facet
/// do not change the result in one way only. Of a union, an intersection or a difference of
/// embedded operands it is excluded: where a facet of one operand bounds the result on both sides
/// of a line, the others add nothing but wedges on one side of it, or take them away.
[[nodiscard]] bool may_have_straight_crossings(const LeafProblem& problem);

}  // namespace trisect::detail
