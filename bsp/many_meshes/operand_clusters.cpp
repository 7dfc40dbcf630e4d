// SPDX-License-Identifier: Apache-2.0
//
// A sweep along the longest axis: an operand looks at those that end behind its beginning.

#include <trisect/bsp/many_meshes/operand_clusters.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {

namespace {

std::size_t longest_axis(std::span<const Box> boxes, std::span<const std::uint32_t> slots) {
    Box all;
    for (const std::uint32_t s : slots) all.add(boxes[s]);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
    return axis;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> operand_clusters(std::span<const Box> boxes,
                                                         std::span<const std::uint32_t> slots) {
    if (slots.empty()) return {};
    const std::size_t axis = longest_axis(boxes, slots);
    std::vector<std::uint32_t> order(slots.begin(), slots.end());
    std::ranges::sort(order, {}, [&](std::uint32_t s) { return std::tuple(boxes[s].lo[axis], s); });
    DisjointSets joined;
    joined.start(boxes.size());
    std::vector<std::uint32_t> near;
    for (const std::uint32_t s : order) {
        std::erase_if(near, [&](std::uint32_t n) { return boxes[n].hi[axis] < boxes[s].lo[axis]; });
        for (const std::uint32_t n : near)
            if (boxes[n].overlaps(boxes[s])) joined.join(n, s);
        near.push_back(s);
    }
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
