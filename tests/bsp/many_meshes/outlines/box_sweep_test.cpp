// SPDX-License-Identifier: Apache-2.0
//
// Pairs of boxes that meet (box_sweep.h), beside all pairs.

#include <trisect/bsp/many_meshes/outlines/box_sweep.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::Box;
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs all_meeting(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& slots) {
    Pairs out;
    for (const std::uint32_t s : slots)
        for (const std::uint32_t t : slots)
            if (s < t && boxes[s].overlaps(boxes[t])) out.insert({s, t});
    return out;
}

// Along any axis, with some that touch, and some without an extent.
TEST(BoxSweep, FindsEachPairOnce) {
    std::mt19937 random(1);
    for (std::size_t longest = 0; longest < 3; ++longest)
        for (int turn = 0; turn < 20; ++turn) {
            std::vector<Box> boxes(40);
            std::vector<std::uint32_t> slots;
            for (std::uint32_t s = 0; s < boxes.size(); ++s) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const int extent = k == longest ? 40 : 12;
                    boxes[s].lo[k] = std::uniform_int_distribution(-extent, extent)(random);
                    boxes[s].hi[k] = boxes[s].lo[k] + std::uniform_int_distribution(0, 6)(random);
                }
                if (s % 5 != 0) slots.push_back(s);
            }
            Pairs found;
            trisect::detail::for_each_meeting(boxes, slots, [&](std::uint32_t s, std::uint32_t t) {
                EXPECT_LE(boxes[s].lo[longest], boxes[t].lo[longest]);
                EXPECT_TRUE(found.insert(std::minmax(s, t)).second);
            });
            EXPECT_EQ(found, all_meeting(boxes, slots));
        }
}

TEST(BoxSweep, LeavesOutEmptyBoxes) {
    std::vector<Box> boxes(3);
    boxes[1].lo = boxes[2].lo = {0, 0, 0};
    boxes[1].hi = boxes[2].hi = {9, 2, 2};
    std::size_t found = 0;
    trisect::detail::for_each_meeting(boxes, std::vector<std::uint32_t>{0, 1, 2},
                                      [&](std::uint32_t, std::uint32_t) { ++found; });
    EXPECT_EQ(found, 1U);
    trisect::detail::for_each_meeting(boxes, {}, [&](std::uint32_t, std::uint32_t) { ++found; });
    EXPECT_EQ(found, 1U);
}

}  // namespace
