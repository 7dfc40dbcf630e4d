// SPDX-License-Identifier: Apache-2.0
//
// EvaluateStats: counters and report of one evaluation, together.
#pragma once

#include <cstdint>

#include <trisect/bsp/expression.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect::test {

struct EvaluateStats : EvaluateCounters {
    std::uint64_t memory = 0;
    int depth = 0;
    LatticeReport lattice;
};

/// Found by the type of its last argument.
[[nodiscard]] inline Solid evaluate(const Expression& expression, const EvaluateOptions& options,
                                    EvaluateStats* stats) {
    const Diagnostics<EvaluateCounters> diagnostics;
    EvaluateReport report;
    Solid out = trisect::evaluate(expression, options, &report);
    if (stats != nullptr)
        *stats = {diagnostics.counters(), report.memory, report.depth, report.lattice};
    return out;
}

}  // namespace trisect::test
