// SPDX-License-Identifier: Apache-2.0
//
// Vertices that hang together (vertex_sides.h), items by numbers (buckets.h) and stable sorts
// (sort_few.h), against naive ones.

#include <trisect/bsp/many_meshes/buckets.h>
#include <trisect/bsp/many_meshes/sort_few.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::Buckets;
using trisect::detail::sort_few;
using trisect::detail::VertexSides;
using Side = VertexSides::Side;

TEST(VertexSides, JoinWhatIsInUse) {
    std::mt19937 random(3);
    VertexSides sides;
    for (std::uint32_t turn = 1; turn < 30; ++turn) {
        const std::uint32_t first = 13 * (turn % 4);
        const std::uint32_t count = 37 * turn;
        std::uniform_int_distribution<std::uint32_t> any(first, first + count - 1);
        sides.start(first + count + 9);
        sides.start_list(0, first);
        sides.start_list(first, first + count);
        std::set<std::uint32_t> used;
        std::vector<std::uint32_t> part(first + count);  // the least of each, by relabelling
        for (std::uint32_t v = 0; v < part.size(); ++v) part[v] = v;
        for (std::uint32_t i = 0; i < count / 2; ++i) {
            const std::uint32_t a = any(random);
            const std::uint32_t b = any(random);
            sides.use(a);
            sides.use(b);
            used.insert({a, b});
            sides.join(a, b);
            EXPECT_TRUE(sides.are_joined(a, a));
            const auto [low, high] = std::minmax(part[a], part[b]);
            std::ranges::replace(part, std::uint32_t{high}, std::uint32_t{low});
        }
        sides.list();
        EXPECT_TRUE(std::ranges::equal(sides.listed(), used));
        for (const std::uint32_t v : used) {
            EXPECT_EQ(sides.root_of(v), part[v]);
            EXPECT_EQ(sides.of(v), Side::Unknown);
        }
        const std::uint32_t some = *used.begin();
        EXPECT_TRUE(sides.mark(some, Side::Open));
        EXPECT_TRUE(sides.mark(some, Side::Open));
        EXPECT_FALSE(sides.mark(some, Side::Closed));
        // Vertices of another list keep what they have.
        sides.start_list(first + count, first + count + 9);
        sides.use(first + count + 8);
        sides.list();
        EXPECT_EQ(sides.listed().size(), 1U);
        EXPECT_EQ(sides.of(some), Side::Open);
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

TEST(SortFew, IsStable) {
    std::mt19937 random(5);
    for (std::size_t count = 0; count < 40; ++count)
        for (int turn = 0; turn < 20; ++turn) {
            std::vector<std::pair<int, int>> items;
            for (std::size_t i = 0; i < count; ++i)
                items.emplace_back(std::uniform_int_distribution(0, 5)(random),
                                   static_cast<int>(i));
            std::vector<std::pair<int, int>> naive = items;
            std::ranges::sort(naive);
            sort_few(std::span(items),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
            EXPECT_EQ(items, naive);
        }
}

}  // namespace
