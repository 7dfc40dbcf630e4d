// SPDX-License-Identifier: Apache-2.0
//
// Operations on many meshes of which only triangles may be wanted.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>

namespace trisect::detail {

/// Whether a formula is a union, an intersection or a difference of three imported meshes or more,
/// or of these of each other (NestedFormula), none of which has an index, and neither work nor
/// memory is limited.
[[nodiscard]] bool may_be_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                                      const EvaluateSettings& options);
/// And whether their boxes mostly overlap, or stand on each other, or the first one's has half of
/// all, or boxes touch or are apart, or most facets are long and thin, or operations are nested;
/// and, but for few facets, whether most are in the formula's reach: else more is compared pair by
/// pair than in cells.
[[nodiscard]] bool are_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                                   const EvaluateSettings& options);

/// Whether boxes mostly overlap. \pre may_be_many_meshes() of some formula
[[nodiscard]] bool do_fill_one_place(const SolidStates& solids);
/// Whether boxes of at least half of all end where other ones begin, with a part of a plane in
/// common. \pre may_be_many_meshes() of some formula. O(n log n)
[[nodiscard]] bool do_stand_on_each_other(const SolidStates& solids);
/// Whether no two boxes meet. \pre as above
[[nodiscard]] bool do_lie_apart(const SolidStates& solids);
/// Whether each box but the largest lies within the next larger one. \pre as above. O(n log n)
[[nodiscard]] bool are_nested(const SolidStates& solids);

/// The value of such a formula, with that tree. Nothing where sides are not known. What it returns
/// does not depend on the number of threads. \pre may_be_many_meshes()
[[nodiscard]] std::optional<SolidForm> evaluate_many_without_tree(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    EvaluateStats& stats, std::shared_ptr<const LazyTree> tree);
/// The same by infinitesimal moves the wrong way, with all sheets of no thickness that these leave:
/// for tests.
[[nodiscard]] std::optional<SolidForm> evaluate_many_with_sheets(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    EvaluateStats& stats, std::shared_ptr<const LazyTree> tree);

}  // namespace trisect::detail
