// SPDX-License-Identifier: Apache-2.0
//
// EvaluateStats: counters of one evaluation, and what it held.
#pragma once

#include <algorithm>
#include <cstdint>

#include <trisect/bsp/expression.h>

namespace trisect::detail {

struct EvaluateStats : EvaluateCounters {
    std::uint64_t memory = 0;  ///< most bytes held at once
    int depth = 0;

    /// Adds another part of the same evaluation.
    EvaluateStats& operator+=(const EvaluateStats& part) {
        EvaluateCounters::operator+=(part);
        memory = std::max(memory, part.memory);
        depth = std::max(depth, part.depth);
        return *this;
    }
};

}  // namespace trisect::detail
