// SPDX-License-Identifier: Apache-2.0
//
// EvaluateSettings: options of an evaluation, with what limits it.
#pragma once

#include <cstdint>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/evaluate_stats.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

struct ChangedBox;

/// The work of one evaluation under a limit, on one thread.
struct WorkBudget {
    StopScope::WorkLeft left;
    std::uint64_t done = 0;
};

/// Without a LimitedEvaluation nothing limits it.
struct EvaluateSettings : EvaluateOptions {
    std::uint32_t splitting_offset = usual_splitting_offset;
    const StopScope* scope = nullptr;    ///< its flags stop all threads
    WorkBudget* budget = nullptr;        ///< null: no limit
    std::uint64_t max_memory = 0;        ///< 0: no limit
    const ChangedBox* change = nullptr;  ///< the rest is that of a set before (edited_formula.h)
};

/// Puts an evaluation under the scopes of the calling thread while it lives, and counts its work
/// there.
class LimitedEvaluation {
public:
    explicit LimitedEvaluation(EvaluateSettings& settings);
    LimitedEvaluation(const LimitedEvaluation&) = delete;
    LimitedEvaluation& operator=(const LimitedEvaluation&) = delete;
    /// Counts what was done until it failed.
    ~LimitedEvaluation();
    /// Counts all work of an evaluation that is complete. \throw CancelledError, LimitError
    void finish(const EvaluateStats& made);

private:
    WorkBudget budget_;
};

/// \throw LimitError when the work so far exceeds the budget, CancelledError when cancelled.
void check_budget(const EvaluateSettings& settings, const EvaluateStats& stats);

/// Sets the offset of all evaluations that this thread starts while it lives. For tests of vertices
/// on splitting planes: results do not depend on it. Scopes nest.
class SplittingOffset {
public:
    /// \throw UsageError unless the offset is odd, no multiple of three and below 192: another one
    /// could put a splitting plane through a corner or a reference point (cell.h)
    explicit SplittingOffset(std::uint32_t offset);
    SplittingOffset(const SplittingOffset&) = delete;
    SplittingOffset& operator=(const SplittingOffset&) = delete;
    ~SplittingOffset();

    [[nodiscard]] static std::uint32_t of_thread();

private:
    std::uint32_t outer_;
};

}  // namespace trisect::detail
