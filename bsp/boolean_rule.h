// SPDX-License-Identifier: Apache-2.0
//
// BooleanRule: a boolean operation on two sets, as a truth table.
#pragma once

#include <cstdint>

namespace trisect {

/// What a boolean operation becomes once one of its operands is known to be constant.
enum class UnaryRule : std::uint8_t { Out, In, Keep, Complement };

/// Bit 2·a + b of the table says whether a point is in the result when `a` and `b` say whether it
/// is in the first and in the second operand. Value type; all sixteen operations are possible.
class BooleanRule {
public:
    constexpr explicit BooleanRule(std::uint8_t table)
        : table_(static_cast<std::uint8_t>(table & 15U)) {}

    [[nodiscard]] static constexpr BooleanRule set_union() { return BooleanRule(0b1110); }
    [[nodiscard]] static constexpr BooleanRule set_intersection() { return BooleanRule(0b1000); }
    [[nodiscard]] static constexpr BooleanRule set_difference() { return BooleanRule(0b0100); }
    [[nodiscard]] static constexpr BooleanRule symmetric_difference() {
        return BooleanRule(0b0110);
    }

    [[nodiscard]] constexpr bool operator()(bool a, bool b) const {
        return ((table_ >> ((a ? 2U : 0U) + (b ? 1U : 0U))) & 1U) != 0;
    }
    /// As a function of the second operand, the first one being known.
    [[nodiscard]] constexpr UnaryRule given_first(bool a) const {
        return unary((*this)(a, false), (*this)(a, true));
    }
    /// As a function of the first operand, the second one being known.
    [[nodiscard]] constexpr UnaryRule given_second(bool b) const {
        return unary((*this)(false, b), (*this)(true, b));
    }
    friend constexpr bool operator==(BooleanRule, BooleanRule) = default;

private:
    static constexpr UnaryRule unary(bool of_out, bool of_in) {
        if (of_out == of_in) return of_in ? UnaryRule::In : UnaryRule::Out;
        return of_in ? UnaryRule::Keep : UnaryRule::Complement;
    }
    std::uint8_t table_;
};

}  // namespace trisect
