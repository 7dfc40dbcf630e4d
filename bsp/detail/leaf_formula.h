// SPDX-License-Identifier: Apache-2.0
//
// The formula of a leaf as a function of winding numbers.
#pragma once

#include <limits>
#include <span>

#include <trisect/bsp/detail/leaf_problem.h>
#include <trisect/bsp/detail/residual.h>

namespace trisect::detail {

inline constexpr int unknown_winding = std::numeric_limits<int>::min();

/// Evaluates the formula; `values` is scratch with an entry for every slot.
class LeafFormula {
public:
    LeafFormula(const LeafProblem& problem, SlotValues& values)
        : problem_(problem), values_(values) {}

    /// 0 or 1; -1 when the winding numbers that are known do not decide it.
    [[nodiscard]] int bound_at(std::span<const int> windings) {
        for (std::size_t o = 0; o < windings.size(); ++o) {
            const LeafOperand& operand = problem_.operands[o];
            std::int8_t& value = values_[static_cast<std::size_t>(operand.slot)];
            value = -1;
            if (windings[o] != unknown_winding)
                value = is_inside(windings[o], problem_.options->winding) ? 1 : 0;
        }
        return bounded_value_of(*problem_.formula, values_);
    }

private:
    const LeafProblem& problem_;
    SlotValues& values_;
};

}  // namespace trisect::detail
