// SPDX-License-Identifier: Apache-2.0
//
// Work limit and cancellation of long computations.
#pragma once

#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// \throw LimitError when the work so far exceeds the budget, CancelledError when cancelled.
void check_budget(const EvaluateOptions& options, const EvaluateStats& stats);

}  // namespace trisect::detail
