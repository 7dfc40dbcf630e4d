// SPDX-License-Identifier: Apache-2.0
//
// Merging: a boolean operation on two BspTrees, without boundaries.
#pragma once

#include <trisect/bsp/boolean_rule.h>
#include <trisect/bsp/bsp_tree.h>

namespace trisect {

/// The regularised result of the operation, reduced. Exact; deterministic.
///
/// Coincident planes, of equal or opposite orientation, are recognised; operands may touch in any
/// way. Cost: one partition of (what is left of) b per node of a, O(size of the parts) each; the
/// result has O(|a| · |b|) nodes in the worst case, about |a| + |b| + cuts for solids that meet in
/// a few places. Where trees are lists (convex solids), sections alone cost O(|a|² + |b|²).
[[nodiscard]] BspTree merge(const BspTree& a, const BspTree& b, BooleanRule rule);

/// Whether two trees describe the same set: their symmetric difference has no In cell.
[[nodiscard]] bool is_same_set(const BspTree& a, const BspTree& b);

}  // namespace trisect
