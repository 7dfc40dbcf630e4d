// SPDX-License-Identifier: Apache-2.0
//
// A tree divides what it lists into convex pieces. A mesh of the result needs none of them, and for
// a plate with thousands of holes in one face making them takes ten times as long as finding out
// where the holes are. So they are made on demand of those that need them: a query, a B-rep, the
// next operation.

#include <trisect/bsp/cells/lazy_tree.h>

#include <utility>

#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

LazyTree::LazyTree(Residual::Ref formula, SolidStates solids, const EvaluateSettings& settings,
                   Evaluate evaluate)
    : formula_(std::move(formula)),
      solids_(std::move(solids)),
      settings_(settings),
      evaluate_(evaluate) {
    // The limits are those of the thread that makes the tree, and of that time.
    settings_.scope = nullptr;
    settings_.budget = nullptr;
    settings_.max_memory = 0;
}

const std::shared_ptr<const SolidState>& LazyTree::cut() const {
    const WorkLock lock(cutting_);
    if (cut_ == nullptr) cut_ = make_ ? make_() : evaluate_(formula_, solids_, settings_);
    return cut_;
}

bool LazyTree::is_cut() const {
    const WorkLock lock(cutting_);
    return cut_ != nullptr;
}

}  // namespace trisect::detail
