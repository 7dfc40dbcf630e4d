// SPDX-License-Identifier: Apache-2.0
//
// ClashTiles: cells of space, each with the boxes in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clash_division.h"
#include "clash_pairs.h"

namespace trisect::app {

/// Of about 128 boxes each, fewer where many pairs are near. A box is in the list of each cell that
/// it meets when grown upwards by what clearances need (add_candidates).
class ClashTiles {
public:
    ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits);
    /// Of a part of space: a cell of a division of all of it.
    /// \param most load of a tile
    ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits, const Bounds& space,
               double most);

    /// What a tile may have where `boxes` have all this load.
    [[nodiscard]] static double most_load(double all, double boxes);

    [[nodiscard]] std::size_t size() const { return division_.size(); }
    /// Unbounded on the outside.
    [[nodiscard]] const Bounds& cell(std::size_t tile) const { return division_.cell(tile); }
    /// Places in what the constructor was given, ascending.
    [[nodiscard]] std::span<const std::uint32_t> boxes(std::size_t tile) const {
        return {listed_.data() + begins_[tile], begins_[tile + 1] - begins_[tile]};
    }
    [[nodiscard]] std::size_t listed() const { return listed_.size(); }

private:
    void list(std::span<const ClashBox> boxes, double most);

    ClashDivision division_;
    std::vector<std::size_t> begins_;
    std::vector<std::uint32_t> listed_;
};

}  // namespace trisect::app
