// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/page_regions.h>

#if defined(__linux__)

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <trisect/kernel/support/block_pool.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace {

using trisect::detail::BlockPool;
using trisect::detail::MemoryBlock;
using trisect::detail::PageRegions;
using trisect::detail::PoolArray;

constexpr std::size_t large_page = PageRegions::large_page;

bool has_only(const MemoryBlock& block, int value) {
    for (std::size_t i = 0; i < block.size; i += 512)
        if (block.memory[i] != static_cast<std::byte>(value)) return false;
    return block.memory[block.size - 1] == static_cast<std::byte>(value);
}

TEST(PageRegions, BlocksDoNotOverlapAndAllOfThemComesTogetherAgain) {
    PageRegions regions(8 * large_page);
    std::mt19937 random(1);
    struct Taken {
        MemoryBlock block;
        int value;
    };
    std::vector<Taken> taken;
    for (int step = 0; step < 4000; ++step) {
        if (taken.empty() || random() % 5 < 3) {
            // Mostly small ones; some of several large pages.
            const std::size_t pages = random() % 16 == 0 ? 1 + random() % 2000 : 1 + random() % 40;
            const MemoryBlock block = regions.take(pages * BlockPool::granule).block;
            ASSERT_EQ(block.size, pages * BlockPool::granule);
            ASSERT_EQ(reinterpret_cast<std::uintptr_t>(block.memory) % BlockPool::granule, 0U);
            taken.push_back({block, step % 251});
            std::memset(block.memory, step % 251, block.size);
        } else {
            std::swap(taken[random() % taken.size()], taken.back());
            ASSERT_TRUE(has_only(taken.back().block, taken.back().value)) << step;
            regions.give_back(taken.back().block);
            taken.pop_back();
        }
        ASSERT_LE(regions.ready(), 8 * large_page);
        if (taken.size() > 200)
            for (; taken.size() > 20; taken.pop_back()) {
                ASSERT_TRUE(has_only(taken.back().block, taken.back().value)) << step;
                regions.give_back(taken.back().block);
            }
    }
    for (const Taken& t : taken) regions.give_back(t.block);
    // Free spans have joined: a whole large page is there.
    const std::size_t mapped = regions.mapped();
    EXPECT_GE(mapped, regions.ready());
    const MemoryBlock one = regions.take(large_page).block;
    EXPECT_EQ(regions.mapped(), mapped);
    regions.give_back(one);
}

TEST(PageRegions, GiveBackWhatGoesBeyondTheReadyOnes) {
    PageRegions regions(2 * large_page);
    const MemoryBlock large = regions.take(50 * large_page).block;
    std::memset(large.memory, 1, large.size);
    EXPECT_EQ(regions.ready(), 0U);
    EXPECT_EQ(regions.mapped(), 50 * large_page);
    regions.give_back(large);
    EXPECT_EQ(regions.ready(), 2 * large_page);

    PageRegions none(0);
    const MemoryBlock first = none.take(3 * large_page).block;
    const MemoryBlock second = none.take(BlockPool::granule).block;
    EXPECT_GT(none.mapped(), 3 * large_page);
    none.give_back(first);
    none.give_back(second);
    EXPECT_EQ(none.mapped(), 0U);
}

// The same blocks again, in whatever order they come: nothing new is mapped.
TEST(PageRegions, ServeARepeatedTaskFromWhatTheyHave) {
    PageRegions regions(BlockPool::ready_bytes);
    const std::vector<std::size_t> sizes{3, 900, 17, 230, 600, 2, 230, 44};
    std::set<std::byte*> places;
    std::size_t mapped = 0;
    for (int run = 0; run < 20; ++run) {
        std::vector<MemoryBlock> blocks;
        for (const std::size_t pages : sizes)
            blocks.push_back(regions.take(pages * BlockPool::granule).block);
        for (const MemoryBlock& b : blocks) places.insert(b.memory);
        for (std::size_t i = 0; i < blocks.size(); ++i)
            regions.give_back(blocks[(i * 3 + static_cast<std::size_t>(run)) % blocks.size()]);
        if (run == 0) mapped = regions.mapped();
        EXPECT_EQ(regions.mapped(), mapped) << run;
    }
    EXPECT_EQ(places.size(), sizes.size());
}

TEST(PageRegions, HaveNoMemoryForBlocksBeyondTheAddressSpace) {
    PageRegions regions(0);
    EXPECT_THROW((void)regions.take(std::size_t{1} << 62), std::bad_alloc);
    EXPECT_THROW((void)regions.take(~std::size_t{BlockPool::granule - 1}), std::bad_alloc);
    EXPECT_THROW((void)BlockPool::take(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
    regions.give_back(regions.take(BlockPool::granule).block);
    EXPECT_EQ(regions.mapped(), 0U);
}

TEST(BlockPool, ServesManyThreads) {
    std::vector<std::thread> threads;
    std::vector<int> wrong(4);
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([t, &wrong] {
            std::mt19937 random(static_cast<unsigned>(t));
            for (int step = 0; step < 500; ++step) {
                const PoolArray<std::uint32_t> values(2048 + random() % 100'000);
                values[0] = values[2047] = static_cast<std::uint32_t>(t);
                const PoolArray<std::uint32_t> others(2048 + random() % 1000);
                others[0] = others[2047] = 99;
                wrong[static_cast<std::size_t>(t)] +=
                    values[0] != static_cast<std::uint32_t>(t) || values[2047] != values[0];
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4));
}

}  // namespace

#endif
