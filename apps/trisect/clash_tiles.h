// SPDX-License-Identifier: Apache-2.0
//
// ClashTiles: cells of space with about the same work.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clash_pairs.h"

namespace trisect::app {

/// A binary partition by planes perpendicular to the axes, chosen by a sample of the middles of
/// boxes, each with the work that is expected of it. It depends on the boxes alone, so that all
/// processes, and a run that is gone on with, have the same.
///
/// Cells are half-open and fill space. A box is in the list of each cell that it meets when grown
/// upwards by what clearances need (add_candidates).
class ClashTiles {
public:
    ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits);

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    /// Unbounded on the outside.
    [[nodiscard]] const Bounds& cell(std::size_t tile) const { return cells_[tile]; }
    /// Places in what the constructor was given, ascending.
    [[nodiscard]] std::span<const std::uint32_t> boxes(std::size_t tile) const {
        return {listed_.data() + begins_[tile], begins_[tile + 1] - begins_[tile]};
    }
    [[nodiscard]] std::size_t listed() const { return listed_.size(); }

private:
    // A leaf has the number of its tile instead of children.
    struct Node {
        double value = 0;
        std::uint32_t axis = 3;  // 3: a leaf
        std::uint32_t below = 0;
        std::uint32_t above = 0;
    };
    class Builder;
    friend class Builder;

    template <class Visit>
    void visit(std::uint32_t from, const Bounds& grown, const Visit& found) const;
    void list(std::span<const ClashBox> boxes, double most);

    std::vector<Node> nodes_;
    std::vector<Bounds> cells_;
    std::vector<std::size_t> begins_;
    std::vector<std::uint32_t> listed_;
};

}  // namespace trisect::app
