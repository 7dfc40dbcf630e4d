// SPDX-License-Identifier: Apache-2.0
//
// FlatWalk: a walk around all vertices of an arrangement.
// It finds the value of a formula on both sides of every edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/flat/flat_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>

namespace trisect::detail {

/// Half-edges: 2 e begins where edge e does, 2 e + 1 where it ends.
class FlatWalk {
public:
    using Index = std::uint32_t;

    FlatWalk(const FlatArrangement& arrangement, LeafFormula& formula);

    /// \pre `sides` has a byte for each edge. They get 1 where the left is inside, 2 where the
    /// right is.
    void find_sides(std::span<std::uint8_t> sides);
    /// Half-edges that leave a vertex, counter-clockwise from the direction of u on.
    [[nodiscard]] std::span<const Index> around(Index vertex) const {
        return std::span(around_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }
    [[nodiscard]] Index origin(Index half) const {
        const auto& e = arrangement_.edges()[half / 2];
        return half % 2 == 0 ? e.from : e.to;
    }
    [[nodiscard]] Index target(Index half) const { return origin(half ^ 1U); }
    /// Whether it runs as its line does.
    [[nodiscard]] bool runs_along(Index half) const {
        return arrangement_.edges()[half / 2].along == (half % 2 == 0);
    }

private:
    struct Step {
        Index vertex = 0;
        Index start = 0;  // the first half-edge to cross
        Index count = 0;  // that were crossed
    };
    void list_around();
    void sort_around(Index vertex);
    [[nodiscard]] bool is_upper(Index half) const;
    [[nodiscard]] std::vector<Index> component_starts() const;
    void start_at(Index vertex);
    void end_component();
    void walk_from(Index vertex, std::span<std::uint8_t> sides);
    void cross(Index half);
    void change(Index operand, int by);
    [[nodiscard]] bool is_inside() const { return formula_.value(row_) > 0; }

    const FlatArrangement& arrangement_;
    LeafFormula& formula_;
    std::vector<int> row_;
    std::vector<int> winding_;
    std::vector<Index> first_;   // by vertex
    std::vector<Index> around_;  // half-edges
    std::vector<Index> place_;   // by half-edge: among those around its origin
    std::vector<bool> is_known_;
    std::vector<Index> base_;  // operands that are not 0 where the component begins
    std::vector<Step> steps_;
};

}  // namespace trisect::detail
