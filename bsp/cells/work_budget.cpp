// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/work_budget.h>

#include <algorithm>
#include <string>

#include <trisect/bsp/cells/cell.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

constinit thread_local std::uint32_t splitting_offset_of_thread = usual_splitting_offset;

std::uint64_t work_of(const EvaluateStats& stats) { return stats.cells + stats.pairs_boxes; }

}  // namespace

LimitedEvaluation::LimitedEvaluation(EvaluateSettings& settings) {
    const StopScope* const scope = stop_scope_of_thread;
    if (scope == nullptr) return;
    settings.scope = scope;
    settings.max_memory = scope->max_memory();
    budget_.left = scope->work_left();
    if (budget_.left.max_work != 0) settings.budget = &budget_;
}

LimitedEvaluation::~LimitedEvaluation() {
    if (stop_scope_of_thread != nullptr) stop_scope_of_thread->count(budget_.done);
}

void LimitedEvaluation::finish(const EvaluateStats& made) {
    budget_.done = 0;
    check_stop(work_of(made));
}

void check_budget(const EvaluateSettings& settings, const EvaluateStats& stats) {
    check_flags(settings.scope);
    if (settings.budget == nullptr) return;
    WorkBudget& budget = *settings.budget;
    const std::uint64_t work = work_of(stats);
    budget.done = std::max(budget.done, work);
    if (work > budget.left.units) StopScope::throw_spent(budget.left.max_work);
}

SplittingOffset::SplittingOffset(std::uint32_t offset) : outer_(splitting_offset_of_thread) {
    if (!may_be_splitter(offset) || offset >= splitting_scale)
        throw UsageError("SplittingOffset: must be odd, no multiple of three and below " +
                         std::to_string(splitting_scale));
    splitting_offset_of_thread = offset;
}

SplittingOffset::~SplittingOffset() { splitting_offset_of_thread = outer_; }

std::uint32_t SplittingOffset::of_thread() { return splitting_offset_of_thread; }

}  // namespace trisect::detail
