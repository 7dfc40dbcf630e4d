// SPDX-License-Identifier: Apache-2.0
//
// A tree divides what it lists into convex pieces. A mesh of the result needs none of them, and for
// a plate with thousands of holes in one face making them takes ten times as long as finding out
// where the holes are. So they are made on demand of those that need them: a query, a B-rep, the
// next operation.

#include <trisect/bsp/cells/lazy_tree.h>

#include <utility>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

LazyTree::LazyTree(Residual::Ref formula, SolidStates solids, const EvaluateOptions& options,
                   Evaluate evaluate)
    : formula_(std::move(formula)),
      solids_(std::move(solids)),
      options_(options),
      evaluate_(evaluate) {
    options_.cancel = nullptr;
}

const std::shared_ptr<const SolidState>& LazyTree::cut() const {
    const std::lock_guard lock(cutting_);
    if (cut_ != nullptr) return cut_;
    EvaluateOptions options = options_;
    options.cancel = cancel_of_thread();
    return cut_ = evaluate_(formula_, solids_, options);
}

bool LazyTree::is_cut() const {
    const std::lock_guard lock(cutting_);
    return cut_ != nullptr;
}

}  // namespace trisect::detail
