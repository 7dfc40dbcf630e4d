// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/operand_clusters.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include <trisect/bsp/many_meshes/outlines/box_sweep.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {

std::vector<std::vector<std::uint32_t>> operand_clusters(std::span<const Box> boxes,
                                                         std::span<const std::uint32_t> slots) {
    if (slots.empty()) return {};
    DisjointSets joined;
    joined.start(boxes.size());
    for_each_meeting(boxes, slots, [&](std::uint32_t s, std::uint32_t t) { joined.join(s, t); });
    std::vector<std::vector<std::uint32_t>> out;
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> cluster(boxes.size(), none);
    for (const std::uint32_t s : slots) {
        std::uint32_t& c = cluster[joined.root(s)];
        if (c == none) {
            c = static_cast<std::uint32_t>(out.size());
            out.emplace_back();
        }
        out[c].push_back(s);
    }
    return out;
}

void order_in_space(std::span<const Box> boxes, std::span<std::uint32_t> slots) {
    if (slots.size() < 3) return;
    const auto middle = [&](std::uint32_t s, std::size_t k) {
        return boxes[s].lo[k] + boxes[s].hi[k];
    };
    Box all;
    all.lo.fill(std::numeric_limits<std::int64_t>::max());
    all.hi.fill(std::numeric_limits<std::int64_t>::min());
    for (const std::uint32_t s : slots)
        for (std::size_t k = 0; k < 3; ++k) {
            all.lo[k] = std::min(all.lo[k], middle(s, k));
            all.hi[k] = std::max(all.hi[k], middle(s, k));
        }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
    const auto half = static_cast<std::ptrdiff_t>(slots.size() / 2);
    std::ranges::nth_element(slots, slots.begin() + half, {},
                             [&](std::uint32_t s) { return std::pair(middle(s, axis), s); });
    order_in_space(boxes, slots.first(slots.size() / 2));
    order_in_space(boxes, slots.subspan(slots.size() / 2));
}

}  // namespace trisect::detail
