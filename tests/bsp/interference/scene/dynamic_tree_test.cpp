// SPDX-License-Identifier: Apache-2.0
//
// A tree that is changed ten thousand times: always sound, always the pairs of brute force, and not
// much worse than one built anew.
#include <trisect/bsp/interference/scene/dynamic_tree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::hierarchies::CostCounters;
using trisect::hierarchies::DynamicTree;

// On a grid, so that boxes touch, coincide and are flat.
BodyBox random_box(Random& random, int room) {
    BodyBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        b.lo[k] = static_cast<double>(random.between(0, room));
        b.hi[k] = b.lo[k] + static_cast<double>(random.between(0, 3));
    }
    return b;
}

std::vector<BodyPair> brute(const std::map<std::uint32_t, BodyBox>& boxes) {
    std::vector<BodyPair> r;
    for (auto i = boxes.begin(); i != boxes.end(); ++i)
        for (auto j = std::next(i); j != boxes.end(); ++j)
            if (i->second.meets(j->second)) r.push_back({i->first, j->first});
    return r;
}

std::vector<std::uint32_t> brute_meeting(const std::map<std::uint32_t, BodyBox>& boxes,
                                         const BodyBox& box) {
    std::vector<std::uint32_t> r;
    for (const auto& [slot, other] : boxes)
        if (other.meets(box)) r.push_back(slot);
    return r;
}

TEST(DynamicTree, IsSoundAndFindsThePairsOfBruteForceAfterEveryHundredChanges) {
    Random random(3);
    DynamicTree tree;
    const auto phase = trisect::hierarchies::make_dynamic_tree();
    std::map<std::uint32_t, BodyBox> boxes;
    CostCounters counters;
    std::vector<BodyPair> pairs;
    for (int change = 0; change < 10000; ++change) {
        const auto slot = static_cast<std::uint32_t>(random.between(0, 299));
        const BodyBox box = random_box(random, 40);
        if (!boxes.contains(slot)) {
            tree.insert(slot, box);
            phase->insert(slot, box);
            boxes[slot] = box;
        } else if (random.between(0, 3) == 0) {
            tree.remove(slot);
            phase->remove(slot);
            boxes.erase(slot);
        } else {
            BodyBox moved = boxes[slot];
            const auto by = static_cast<double>(random.between(-1, 1));
            moved.lo[0] += by;
            moved.hi[0] += by;
            boxes[slot] = random.between(0, 4) == 0 ? box : moved;
            tree.update(slot, boxes[slot]);
            phase->update(slot, boxes[slot]);
        }
        if (change % 100 != 0) continue;
        ASSERT_TRUE(tree.is_sound()) << change;
        tree.pairs(pairs, counters);
        ASSERT_EQ(pairs, brute(boxes)) << change;
        phase->pairs(pairs);
        ASSERT_EQ(pairs, brute(boxes)) << change;
        const BodyBox asked = random_box(random, 40);
        std::vector<std::uint32_t> met;
        const auto note = [&met](std::uint32_t i) { met.push_back(i); };
        tree.find(asked, note, counters);
        std::sort(met.begin(), met.end());
        ASSERT_EQ(met, brute_meeting(boxes, asked)) << change;
    }
    EXPECT_GT(phase->work().box_tests, 0U);
    EXPECT_GT(phase->bytes(), 0U);
    const double changed = tree.quality();
    const unsigned depth = tree.depth();
    tree.rebuild();
    EXPECT_TRUE(tree.is_sound());
    tree.pairs(pairs, counters);
    EXPECT_EQ(pairs, brute(boxes));
    EXPECT_LT(changed, 1.5 * tree.quality());
    EXPECT_LT(depth, 4 * tree.depth());
}

TEST(DynamicTree, IsEmptyWhenEverythingHasLeft) {
    DynamicTree tree;
    for (std::uint32_t i = 0; i < 5; ++i) tree.insert(i, {{1.0 * i, 0, 0}, {1.0 * i, 1, 1}});
    for (std::uint32_t i = 0; i < 5; ++i) tree.remove(i);
    EXPECT_EQ(tree.size(), 0U);
    EXPECT_TRUE(tree.is_sound());
    CostCounters counters;
    std::vector<BodyPair> pairs;
    tree.pairs(pairs, counters);
    EXPECT_TRUE(pairs.empty());
    tree.find(
        {{-9, -9, -9}, {9, 9, 9}}, [](std::uint32_t) { FAIL(); }, counters);
    tree.rebuild();
    tree.insert(3, {});
    EXPECT_TRUE(tree.is_sound());
}

}  // namespace
