// SPDX-License-Identifier: Apache-2.0
//
// ClashDivision: cells of space with about the same work.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "clash_pairs.h"

namespace trisect::app {

/// All of space.
[[nodiscard]] Bounds unbounded_space();

/// A sample of boxes, each with the work that is expected of it and of its neighbours: one for a
/// box, and `cost_of_a_pair` for a pair that is near.
class ClashLoads {
public:
    struct Item {
        std::array<double, 3> middle{};
        std::uint32_t number = 0;  ///< of the box, where middles are the same
        double load = 1;
    };

    /// \param each how many boxes each one of the sample stands for
    ClashLoads(std::span<const ClashBox> sample, double each, const ClashLimits& limits);

    /// Expected of all boxes that the sample stands for.
    [[nodiscard]] double all() const { return all_; }
    [[nodiscard]] double each() const { return each_; }
    [[nodiscard]] std::vector<Item>& items() { return items_; }

private:
    std::vector<Item> items_;
    double each_ = 1;
    double all_ = 0;
};

/// A binary partition of a cell of space. Cells are half-open. It depends on the sample alone, so
/// that all processes, and a run that is gone on with, have the same.
class ClashDivision {
public:
    // A leaf has the number of its cell instead of children.
    struct Node {
        double value = 0;
        std::uint32_t axis = 3;  ///< 3: a leaf
        std::uint32_t below = 0;
        std::uint32_t above = 0;
    };

    ClashDivision() = default;
    /// Cells have no more than `most` of the load, but where all boxes are in one place.
    /// \pre the middles of the sample are in `space`
    ClashDivision(ClashLoads loads, const Bounds& space, double most);
    ClashDivision(std::vector<Node> nodes, std::vector<Bounds> cells)
        : nodes_(std::move(nodes)), cells_(std::move(cells)) {}

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] const Bounds& cell(std::size_t i) const { return cells_[i]; }
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<Bounds>& cells() const { return cells_; }

    /// The cells that a box meets when it is grown upwards by what clearances need
    /// (add_candidates).
    template <class Visit>
    void for_each_cell(const Bounds& box, double most, const Visit& found) const {
        Bounds grown = box;
        for (double& hi : grown.hi) hi = next_above(hi + most);
        visit(0, grown, found);
    }

private:
    class Builder;

    template <class Visit>
    void visit(std::uint32_t from, const Bounds& grown, const Visit& found) const {
        while (nodes_[from].axis < 3) {
            const Node& node = nodes_[from];
            if (!(grown.lo[node.axis] < node.value)) {
                from = node.above;
                continue;
            }
            if (!(grown.hi[node.axis] < node.value)) visit(node.above, grown, found);
            from = node.below;
        }
        found(nodes_[from].below);
    }

    std::vector<Node> nodes_;
    std::vector<Bounds> cells_;
};

}  // namespace trisect::app
