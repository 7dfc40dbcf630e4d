// SPDX-License-Identifier: Apache-2.0
//
// LazyTree: the tree of a result, evaluated when it is first needed.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// Immutable, safe to use from any thread.
class LazyTree {
public:
    /// Evaluates a formula into a state whose form is a tree. `solids` are its slots.
    using Evaluate = std::shared_ptr<const SolidState> (*)(const Residual::Ref& formula,
                                                           const SolidStates& solids,
                                                           const EvaluateSettings& settings);

    /// `solids` are trees and lie on one lattice.
    LazyTree(Residual::Ref formula, SolidStates solids, const EvaluateSettings& settings,
             Evaluate evaluate);
    /// Of what is made otherwise.
    explicit LazyTree(std::function<std::shared_ptr<const SolidState>()> make)
        : make_(std::move(make)) {}

    /// The set with a tree. Calls during its evaluation wait.
    /// \throw CancelledError, LimitError by the StopScope of the thread that evaluates; nothing is
    /// kept then
    [[nodiscard]] const std::shared_ptr<const SolidState>& cut() const;
    [[nodiscard]] bool is_cut() const;

    /// Null where it is made otherwise.
    [[nodiscard]] const Residual::Ref& formula() const { return formula_; }
    [[nodiscard]] const SolidStates& solids() const { return solids_; }
    [[nodiscard]] const EvaluateSettings& settings() const { return settings_; }

private:
    Residual::Ref formula_;
    SolidStates solids_;
    EvaluateSettings settings_;
    Evaluate evaluate_ = nullptr;
    std::function<std::shared_ptr<const SolidState>()> make_;
    mutable std::mutex cutting_;
    mutable std::shared_ptr<const SolidState> cut_;
};

/// The state of a solid as a tree: for all but what writes triangles.
[[nodiscard]] inline const std::shared_ptr<const SolidState>& cut_state(const Solid& solid) {
    const auto& state = detail::state_of(solid);
    const auto tree = state->lazy_tree();
    return tree != nullptr ? tree->cut() : state;
}

}  // namespace trisect::detail
