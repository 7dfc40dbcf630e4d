// SPDX-License-Identifier: Apache-2.0
//
// NestedFormula: unions, intersections and differences of each other, every operand once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/residual.h>

namespace trisect::detail {

/// A formula with its complements at the operands. So an operand bounds the result on one side all
/// over, and two operands meet in one operation: the lowest one that has both.
class NestedFormula {
public:
    /// An operand, or the union or the intersection of two terms or more, none of which is of the
    /// same kind.
    struct Node {
        std::int32_t slot = -1;
        bool unites = false;
        std::uint32_t parent = 0;  ///< of the root itself
        std::uint32_t depth = 0;
        std::vector<std::uint32_t> terms;
    };

    /// Nothing where an operand is missing or comes twice, for exclusive ors, for less than two
    /// levels and for more than 64.
    [[nodiscard]] static std::optional<NestedFormula> read(const Residual& formula,
                                                           std::size_t slots);

    /// Without some operands, by slot; those that are left have the next slots each. An operation
    /// may have one term or none then.
    [[nodiscard]] NestedFormula without(std::span<const std::uint8_t> operands) const;

    [[nodiscard]] const Node& node(std::uint32_t number) const { return nodes_[number]; }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    static constexpr std::uint32_t root = 0;
    [[nodiscard]] std::uint32_t leaf(std::size_t slot) const { return leaves_[slot]; }
    /// Whether the operand is not complemented.
    [[nodiscard]] bool is_positive(std::size_t slot) const { return positive_[slot] != 0; }
    /// Whether it is intersected with another operand that is not complemented.
    [[nodiscard]] bool is_intersected(std::size_t slot) const;
    /// Whether the operation in which two operands meet is a union.
    [[nodiscard]] bool unites(std::uint32_t slot, std::uint32_t other) const;

private:
    explicit NestedFormula(std::size_t slots) : leaves_(slots, none), positive_(slots, 0) {}
    [[nodiscard]] bool add(const Residual& formula, bool negated, std::uint32_t parent);

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaves_;  // by slot
    std::vector<std::uint8_t> positive_;
};

}  // namespace trisect::detail
