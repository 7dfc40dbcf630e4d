// SPDX-License-Identifier: Apache-2.0
//
// Operands whose boxes hang together (operand_clusters.h), against all pairs.

#include <trisect/bsp/many_meshes/operand_clusters.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::Box;
using trisect::detail::operand_clusters;
using trisect::detail::order_in_space;
using Clusters = std::vector<std::vector<std::uint32_t>>;

Box box(std::int64_t x, std::int64_t y, std::int64_t size) {
    Box b;
    b.lo = {x, y, 0};
    b.hi = {x + size, y + size, size};
    return b;
}

// By joining over and over again.
Clusters by_all_pairs(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& slots) {
    std::vector<std::uint32_t> least(boxes.size());
    std::iota(least.begin(), least.end(), 0U);
    for (bool changes = true; changes;) {
        changes = false;
        for (const std::uint32_t a : slots)
            for (const std::uint32_t b : slots)
                if (least[a] < least[b] && boxes[a].overlaps(boxes[b])) {
                    least[b] = least[a];
                    changes = true;
                }
    }
    Clusters out;
    for (const std::uint32_t root : slots) {
        std::vector<std::uint32_t> all;
        for (const std::uint32_t s : slots)
            if (least[s] == root) all.push_back(s);
        if (!all.empty()) out.push_back(all);
    }
    return out;
}

TEST(OperandClusters, AreWhatAllPairsMake) {
    std::mt19937 random(7);
    std::size_t several = 0;
    for (int round = 0; round < 200; ++round) {
        const auto at = [&](std::uint32_t limit) {
            return static_cast<std::int64_t>(random() % limit);
        };
        std::vector<Box> boxes;
        std::vector<std::uint32_t> slots;
        for (std::uint32_t i = 0; i < 40; ++i) {
            boxes.push_back(box(at(60), at(40), at(8)));
            if (i % 5 != 0) slots.push_back(i);
        }
        const Clusters found = operand_clusters(boxes, slots);
        EXPECT_EQ(found, by_all_pairs(boxes, slots));
        several += found.size() > 2 && found[0].size() + 2 < slots.size() ? 1U : 0U;
    }
    EXPECT_GT(several, 100U);
}

TEST(OperandClusters, ThoseThatTouchHangTogether) {
    const std::vector<Box> boxes{box(0, 0, 2), box(9, 0, 2), box(2, 0, 2), box(5, 0, 3)};
    EXPECT_EQ(operand_clusters(boxes, std::vector<std::uint32_t>{0, 1, 2, 3}),
              (Clusters{{0, 2}, {1}, {3}}));
    EXPECT_EQ(operand_clusters(boxes, std::vector<std::uint32_t>{}), Clusters{});
}

// Whether each half lies on one side of the other one along some axis, by the middles of boxes.
bool is_parted(const std::vector<Box>& boxes, std::span<const std::uint32_t> slots) {
    if (slots.size() < 3) return true;
    const auto first = slots.first(slots.size() / 2);
    const auto second = slots.subspan(slots.size() / 2);
    bool found = false;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto middle = [&](std::uint32_t s) { return boxes[s].lo[k] + boxes[s].hi[k]; };
        found = found || middle(*std::ranges::max_element(first, {}, middle)) <=
                             middle(*std::ranges::min_element(second, {}, middle));
    }
    return found && is_parted(boxes, first) && is_parted(boxes, second);
}

TEST(OrderInSpace, PartsHalvesAlongAnAxis) {
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        const auto at = [&](std::uint32_t limit) {
            return static_cast<std::int64_t>(random() % limit);
        };
        std::vector<Box> boxes;
        for (std::uint32_t i = 0; i < 37; ++i) boxes.push_back(box(at(60), at(40), 2));
        std::vector<std::uint32_t> slots(boxes.size());
        std::iota(slots.begin(), slots.end(), 0U);
        order_in_space(boxes, slots);
        EXPECT_TRUE(is_parted(boxes, slots));
        std::ranges::sort(slots);
        for (std::uint32_t i = 0; i < slots.size(); ++i) EXPECT_EQ(slots[i], i);
    }
}

}  // namespace
