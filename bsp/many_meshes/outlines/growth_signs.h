// SPDX-License-Identifier: Apache-2.0
//
// GrowthSigns: the choice of those of many operands that grow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trisect::detail {

/// A choice of 1 or -1 for each operand so that of each two of which something is wanted at least
/// one does it: clauses of two literals, by propagation (Even, Itai, Shamir 1976).
class GrowthSigns {
public:
    /// What an operand does that grows: 1 what is wanted, -1 the opposite, 0 nothing.
    struct Effect {
        std::uint32_t slot = 0;
        int if_it_grows = 0;
    };

    explicit GrowthSigns(std::size_t slots) : of_slot_(slots) {}
    /// Nothing is wanted where neither has an effect.
    void want(Effect one, Effect other);

    /// Operand by operand the given sign, if what was chosen before allows it. Nothing where there
    /// is no choice. O(wanted) for each operand at most.
    [[nodiscard]] std::optional<std::vector<std::int8_t>> near(
        const std::vector<std::int8_t>& given) const;

private:
    using Signs = std::vector<std::int8_t>;  // 0: not chosen
    [[nodiscard]] bool choose(std::uint32_t slot, std::int8_t sign, Signs& signs) const;

    std::vector<std::array<Effect, 2>> wanted_;
    std::vector<std::vector<std::uint32_t>> of_slot_;  // numbers of these
};

}  // namespace trisect::detail
