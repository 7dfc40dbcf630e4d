// SPDX-License-Identifier: Apache-2.0
//
// OperandOrder: the order in which many operands are combined.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace trisect::detail {

/// Which of them come next to each other in a balanced tree. All by slot.
class OperandOrder {
public:
    OperandOrder(const ManyMeshes& meshes, const SolidStates& solids);

    using Slots = std::vector<std::uint32_t>;

    // Of a formula that is not nested:
    /// Whether the first operand comes last, alone.
    [[nodiscard]] bool first_is_last() const { return first_is_last_; }
    /// Those that are in no cluster, in order.
    [[nodiscard]] const Slots& order() const { return order_; }
    /// None, or several that are apart.
    [[nodiscard]] const std::vector<Slots>& clusters() const { return clusters_; }

    // Of a nested one, by node:
    /// Its terms but neighbours, by node.
    [[nodiscard]] const std::vector<std::uint32_t>& terms(std::uint32_t node) const {
        return terms_[node];
    }
    /// Operands in the order of space. Each of them, or its complement in a union, leaves open what
    /// is far out.
    [[nodiscard]] const Slots& neighbours(std::uint32_t node) const { return neighbours_[node]; }
    [[nodiscard]] bool has_neighbours(std::uint32_t node) const {
        return node < neighbours_.size() && !neighbours_[node].empty();
    }
    /// Where neighbours come first.
    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

    [[nodiscard]] bool is_open_far(std::uint32_t slot) const { return is_open_far_[slot] != 0; }

private:
    [[nodiscard]] std::optional<Box> reach_of(const std::vector<Box>& boxes) const;
    void set_order(const std::vector<Box>& boxes);
    void set_terms(const ManyMeshes& meshes, const SolidStates& solids);
    void order_terms(const NestedFormula& nested, std::uint32_t node);

    std::vector<std::uint8_t> is_open_far_;
    bool first_is_last_ = false;
    Slots order_;
    std::vector<Slots> clusters_;
    std::vector<std::vector<std::uint32_t>> terms_;
    std::vector<Slots> neighbours_;
    std::vector<Box> boxes_;
};

}  // namespace trisect::detail
