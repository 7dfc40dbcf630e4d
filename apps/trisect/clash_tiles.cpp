// SPDX-License-Identifier: Apache-2.0
#include "clash_tiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trisect::app {
namespace {

// A tile is small beside what a rank does, so that ranks that take the next one end at the same
// time, and large beside what is listed twice on its walls.
constexpr double boxes_of_a_tile = 128;
constexpr std::size_t most_samples = std::size_t{1} << 15;  // or an eighth of all, if that is more

ClashLoads loads_of(std::span<const ClashBox> boxes, const ClashLimits& limits) {
    const std::size_t most = std::max(most_samples, boxes.size() / 8);
    const std::size_t stride = std::max<std::size_t>(1, (boxes.size() + most - 1) / most);
    std::vector<ClashBox> sample;
    for (std::size_t i = 0; i < boxes.size(); i += stride) sample.push_back(boxes[i]);
    const double each =
        sample.empty() ? 1 : static_cast<double>(boxes.size()) / static_cast<double>(sample.size());
    return {sample, each, limits};
}

// Walls are between middles, so these must be in the cell.
std::vector<ClashBox> with_middle_in(const Bounds& cell, std::span<const ClashBox> boxes) {
    std::vector<ClashBox> out;
    for (const ClashBox& b : boxes) {
        bool is_in = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const double middle = b.box.lo[k] / 2 + b.box.hi[k] / 2;
            is_in = is_in && cell.lo[k] <= middle && middle < cell.hi[k];
        }
        if (is_in) out.push_back(b);
    }
    return out;
}

}  // namespace

double ClashTiles::most_load(double all, double boxes) {
    return all / std::max(std::ceil(boxes / boxes_of_a_tile), 1.0) * std::sqrt(2.0);
}

ClashTiles::ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits) {
    ClashLoads loads = loads_of(boxes, limits);
    const double most = most_load(loads.all(), static_cast<double>(boxes.size()));
    division_ = ClashDivision(std::move(loads), unbounded_space(), most);
    list(boxes, limits.most());
}

ClashTiles::ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits,
                       const Bounds& space, double most)
    : division_(loads_of(with_middle_in(space, boxes), limits), space, most) {
    list(boxes, limits.most());
}

// Counted, then filled: no list of a tile grows.
void ClashTiles::list(std::span<const ClashBox> boxes, double most) {
    begins_.assign(size() + 1, 0);
    for (const ClashBox& b : boxes)
        division_.for_each_cell(b.box, most, [&](std::uint32_t tile) { ++begins_[tile + 1]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    listed_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        division_.for_each_cell(boxes[i].box, most,
                                [&](std::uint32_t tile) { listed_[next[tile]++] = i; });
}

}  // namespace trisect::app
