// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/work_budget.h>

#include <string>

#include <trisect/kernel/error.h>

namespace trisect::detail {

void check_budget(const EvaluateOptions& options, const EvaluateStats& stats) {
    if (options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed))
        throw CancelledError();
    if (options.max_work != 0 && stats.cells + stats.pairs_boxes > options.max_work)
        throw LimitError("the work budget of " + std::to_string(options.max_work) + " is spent");
}

}  // namespace trisect::detail
