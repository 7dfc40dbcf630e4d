// SPDX-License-Identifier: Apache-2.0
//
// Choice of the next cut, for polygons and for segments alike.
// Polygons are in a cell, segments in a plane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/msp/msp_groups.h>
#include <trisect/bsp/msp_tree.h>

namespace trisect::detail::msp {

/// On which sides of a plane something has parts.
struct Parts {
    bool below = false;
    bool above = false;
    [[nodiscard]] bool is_cut() const { return below && above; }
};

/// Groups of a list that a candidate is tried on, at most: four thousand items. More change the
/// choice little and cost as much as the cut itself, times the candidates.
inline constexpr std::size_t groups_tried = 64;

/// What a cut does to a list. Stops early where the penalty cannot come below `limit`.
template <class Items>
[[nodiscard]] std::uint64_t penalty(const Groups& list, const Items& items, std::uint32_t plane,
                                    const MspOptions& options, std::uint64_t limit) {
    const std::uint64_t weight =
        options.split_heuristic == MspHeuristic::LeastSplits ? 1 : options.split_weight;
    std::uint64_t splits = 0;
    std::uint64_t below = 0;
    std::uint64_t above = 0;
    const std::size_t step = (list.groups().size() + groups_tried - 1) / groups_tried;
    for (std::size_t g = 0; g < list.groups().size(); g += step) {
        const Groups::Pointer& group = list.groups()[g];
        const Side side = list.side(*group, items, items.plane(plane), 1);
        if (side != Side::On) {
            (side == Side::Below ? below : above) += group->items.size();
            continue;
        }
        for (const ItemIndex i : group->items) {
            const Parts parts = items.parts(i, plane);
            if (parts.below) ++below;
            if (parts.above) ++above;
            if (parts.is_cut() && ++splits * weight >= limit) return limit;
        }
    }
    if (options.split_heuristic == MspHeuristic::LeastSplits) return splits;
    return splits * weight + (below > above ? below - above : above - below);
}

/// The item whose plane is to cut. `Items` has for each item its cutting plane (`cut_of`), its
/// parts (`parts`), points and size (`size`), and for a number its plane (`plane`).
/// \pre the list is not empty, options.candidates >= 1
template <class Items>
[[nodiscard]] ItemIndex choose(const Groups& list, const Items& items, const MspOptions& options) {
    const std::size_t n = list.size();
    const std::size_t tried = std::clamp<std::size_t>(options.candidates, 1, n);
    if (options.split_heuristic == MspHeuristic::AsGiven || n == 1) return list.first();
    ItemIndex best = list.item(0);
    std::uint64_t least = ~std::uint64_t{0};
    double largest = -1;
    for (std::size_t k = 0; k < tried; ++k) {
        const ItemIndex candidate = list.item(k * n / tried);
        if (options.split_heuristic == MspHeuristic::LargestFirst) {
            const double size = items.size(candidate);
            if (size > largest) best = candidate;
            largest = std::max(size, largest);
            continue;
        }
        const std::uint64_t p = penalty(list, items, items.cut_of(candidate), options, least);
        if (p < least) best = candidate;
        least = std::min(p, least);
        if (least == 0) break;
    }
    return best;
}

}  // namespace trisect::detail::msp
