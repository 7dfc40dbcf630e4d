// SPDX-License-Identifier: Apache-2.0
//
// Pairs of boxes that meet, by a sweep along the longest axis.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

/// Calls each(s, t) once for every two of the slots of which the boxes meet, where it is the first
/// one's that begins earlier; boxes that touch meet. O(n log n + n m) for m boxes across a plane:
/// without a branch by what is apart, since half of that is foreseen wrongly.
template <class Each>
void for_each_meeting(std::span<const Box> boxes, std::span<const std::uint32_t> slots,
                      const Each& each) {
    Box all;
    for (const std::uint32_t s : slots) all.add(boxes[s]);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
    std::vector<std::pair<std::int64_t, std::uint32_t>> order;
    order.reserve(slots.size());
    for (const std::uint32_t s : slots) order.emplace_back(boxes[s].lo[axis], s);
    std::ranges::sort(order);
    std::vector<Box> sorted;  // across the axis; what is along it comes last
    sorted.reserve(slots.size());
    for (const auto& [lo, s] : order) {
        Box b = boxes[s];
        std::swap(b.lo[axis], b.lo[2]);
        std::swap(b.hi[axis], b.hi[2]);
        sorted.push_back(b);
    }
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const Box a = sorted[i];
        for (std::size_t j = i + 1; j < sorted.size() && order[j].first <= a.hi[2]; ++j) {
            const Box& b = sorted[j];
            bool meet = true;
            for (std::size_t k = 0; k < 2; ++k) {
                meet &= a.lo[k] <= b.hi[k];
                meet &= b.lo[k] <= a.hi[k];
            }
            if (meet) each(order[i].second, order[j].second);
        }
    }
}

}  // namespace trisect::detail
