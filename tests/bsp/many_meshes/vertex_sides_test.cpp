// SPDX-License-Identifier: Apache-2.0
//
// Vertices that hang together (vertex_sides.h), and items by numbers (buckets.h), against naive
// ones.

#include <trisect/bsp/many_meshes/buckets.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::Buckets;
using trisect::detail::VertexSides;
using Side = VertexSides::Side;

TEST(VertexSides, JoinWhatIsListedAnewInEachTurn) {
    std::mt19937 random(3);
    VertexSides sides;
    for (std::uint32_t turn = 1; turn < 30; ++turn) {
        const std::uint32_t count = 40 * turn;
        std::uniform_int_distribution<std::uint32_t> any(0, count - 1);
        sides.start(count);
        sides.start_list();
        std::set<std::uint32_t> listed;
        std::vector<std::uint32_t> part(count);  // the least of each, by relabelling
        for (std::uint32_t v = 0; v < count; ++v) part[v] = v;
        for (std::uint32_t i = 0; i < count / 2; ++i) {
            const std::uint32_t a = any(random);
            const std::uint32_t b = any(random);
            sides.list(a);
            sides.list(b);
            listed.insert({a, b});
            sides.join(a, b);
            const auto [low, high] = std::minmax(part[a], part[b]);
            std::ranges::replace(part, std::uint32_t{high}, std::uint32_t{low});
        }
        EXPECT_EQ(sides.listed().size(), listed.size());
        for (const std::uint32_t v : listed) {
            EXPECT_EQ(sides.root(v), part[v]);
            EXPECT_EQ(sides.of(v), Side::Unknown);
        }
        const std::uint32_t first = *listed.begin();
        EXPECT_TRUE(sides.mark(first, Side::Open));
        EXPECT_TRUE(sides.mark(first, Side::Open));
        EXPECT_FALSE(sides.mark(first, Side::Closed));
        // A second list keeps what the first one has.
        sides.start_list();
        sides.list(first);
        EXPECT_TRUE(sides.listed().empty());
        EXPECT_EQ(sides.of(first), Side::Open);
    }
}

TEST(Buckets, HaveItemsInTheOrderInWhichTheyCame) {
    std::mt19937 random(4);
    Buckets<int> buckets;
    for (std::uint32_t turn = 1; turn < 30; ++turn) {
        const std::uint32_t limit = 100 * turn;
        std::uniform_int_distribution<std::uint32_t> any(0, limit - 1);
        buckets.clear();
        std::map<std::uint32_t, std::vector<int>> naive;
        for (int i = 0; i < 50; ++i) {
            const std::uint32_t key = any(random) / 3;
            buckets.add(key, i);
            naive[key].push_back(i);
        }
        buckets.sort(limit);
        EXPECT_EQ(buckets.buckets().size(), naive.size());
        for (std::uint32_t key = 0; key < limit; ++key) {
            const auto items = buckets.of(key);
            EXPECT_EQ(buckets.has(key), naive.contains(key));
            EXPECT_TRUE(std::ranges::equal(items, naive[key]));
        }
    }
}

}  // namespace
