// SPDX-License-Identifier: Apache-2.0
//
// Residual: what is left of a boolean formula in a cell, after the operands that are constant there
// have been replaced by their value.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trisect::detail {

/// Formula over numbered slots. Immutable, shared between cells.
struct Residual {
    enum class Kind : std::uint8_t { Constant, Slot, Not, And, Or, Xor };
    using Ref = std::shared_ptr<const Residual>;

    Kind kind = Kind::Constant;
    bool value = false;  ///< of a constant
    std::int32_t slot = -1;
    std::vector<Ref> children;

    [[nodiscard]] static Ref constant(bool value);
    [[nodiscard]] static Ref of_slot(std::int32_t slot);
    /// Simplifies constants, double negations and nested operators of one kind.
    [[nodiscard]] static Ref negation(Ref a);
    [[nodiscard]] static Ref combination(Kind kind, std::span<const Ref> terms);
};

/// Values of slots during simplification: -1 unknown, 0 outside, 1 inside.
using SlotValues = std::vector<std::int8_t>;

/// Replaces known slots. Returns the same object where nothing changed.
[[nodiscard]] Residual::Ref simplified(const Residual::Ref& formula, const SlotValues& values);

/// The formula's value; every slot that it names must be known.
[[nodiscard]] bool value_of(const Residual& formula, const SlotValues& values);

/// Calls visit(slot) for every occurrence of a slot.
template <class Visit>
void for_each_slot(const Residual& formula, Visit&& visit) {
    if (formula.kind == Residual::Kind::Slot) visit(formula.slot);
    for (const auto& c : formula.children) for_each_slot(*c, visit);
}

}  // namespace trisect::detail
