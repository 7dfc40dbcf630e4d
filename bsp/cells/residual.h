// SPDX-License-Identifier: Apache-2.0
//
// Residual: a boolean formula in a cell, simplified by constant operands.
// An operand is constant where its boundary does not meet the cell.
//
// A formula is a graph: subformulas that occur several times are one node with several parents, and
// written out as a tree it may be exponentially larger. So a traversal that may meet a node again
// stores its result there.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/end_graph.h>

namespace trisect::detail {

/// Formula over numbered slots. Immutable, shared between cells.
struct Residual {
    enum class Kind : std::uint8_t { Constant, Slot, Not, And, Or, Xor };
    using Ref = std::shared_ptr<const Residual>;

    Residual() = default;
    Residual(const Residual&) = delete;
    Residual& operator=(const Residual&) = delete;
    ~Residual() { end_children(children); }  // formulas may be deep

    Kind kind = Kind::Constant;
    bool value = false;  ///< of a constant
    std::int32_t slot = -1;
    std::vector<Ref> children;
    /// Operations in the formula written out as a tree; stops counting at `many_operations`.
    std::uint32_t operations = 0;

    static constexpr std::uint32_t many_operations = 1U << 30;
    /// Formulas of so few operations are walked as trees: remembering would cost more.
    static constexpr std::uint32_t few_operations = 32;
    [[nodiscard]] bool is_large() const { return operations > few_operations; }

    [[nodiscard]] static Ref constant(bool value);
    [[nodiscard]] static Ref of_slot(std::int32_t slot);
    /// Simplifies constants, double negations, nested operators of one kind, and terms that are the
    /// same object: of those one is left, in an exclusive or none of two.
    [[nodiscard]] static Ref negation(Ref a);
    [[nodiscard]] static Ref combination(Kind kind, std::span<const Ref> terms);
    /// The same for terms that are neither constant, nor of the kind, nor twice the same.
    [[nodiscard]] static Ref of_distinct(Kind kind, std::vector<Ref> terms);
};

/// Values of slots during simplification: -1 unknown, 0 outside, 1 inside.
using SlotValues = std::vector<std::int8_t>;

/// Replaces known slots. Returns the same object where nothing changed.
[[nodiscard]] Residual::Ref simplified(const Residual::Ref& formula, const SlotValues& values);

/// The formula's value; every slot that it names must be known.
[[nodiscard]] bool value_of(const Residual& formula, const SlotValues& values);

/// The formula's value when some slots are unknown: 0 or 1 where those that are known decide it,
/// else -1. May be -1 although no choice of the unknown ones changes the value.
[[nodiscard]] int bounded_value_of(const Residual& formula, const SlotValues& values);

/// Calls visit(slot) once or more for every slot that occurs.
template <class Visit>
void for_each_slot(const Residual& formula, Visit&& visit) {
    std::unordered_set<const Residual*> seen;
    const auto walk = [&](const auto& self, const Residual& r) -> void {
        if (r.kind == Residual::Kind::Slot) visit(r.slot);
        if (formula.is_large() && !r.children.empty() && !seen.insert(&r).second) return;
        with_enough_stack([&] {
            for (const auto& c : r.children) self(self, *c);
        });
    };
    walk(walk, formula);
}

}  // namespace trisect::detail
