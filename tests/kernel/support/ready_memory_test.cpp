// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/ready_memory.h>

namespace {

using trisect::detail::make_ready;
using trisect::detail::PoolVector;
using trisect::detail::resize_ready;

TEST(ReadyMemory, ResizedVectorsKeepWhatTheyHave) {
    std::vector<std::uint32_t> values(100, 7);
    for (const std::size_t size : {100UL, 60UL, 30'000UL, 1'000'000UL, 12'000'000UL, 0UL}) {
        const std::size_t before = values.size();
        std::vector<std::uint32_t> expected = values;
        expected.resize(size);
        resize_ready(values, size);
        EXPECT_EQ(values, expected) << before << " to " << size;
    }
}

// Parts of pages at the ends, which others may use, stay as they are.
TEST(ReadyMemory, ChangesNoValue) {
    constexpr std::size_t size = std::size_t{1} << 21;
    std::vector<std::uint8_t> values(size);
    std::iota(values.begin(), values.end(), std::uint8_t{0});
    const std::vector<std::uint8_t> expected = values;
    for (const std::size_t begin : {0UL, 1UL, 4095UL, 4096UL, 70'001UL})
        make_ready(values.data() + begin, size - begin);
    make_ready(values.data(), 0);
    make_ready(nullptr, 0);
    EXPECT_EQ(values, expected);
}

// Small, of the pool, and made ready: growth goes through all three.
TEST(ReadyMemory, PoolVectorsGrowThroughAllKindsOfBlocks) {
    PoolVector<std::array<std::uint64_t, 3>> values;
    for (std::uint64_t i = 0; i < 100'000; ++i) values.push_back({i, i + 1, i * i});
    for (std::uint64_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(values[i], (std::array<std::uint64_t, 3>{i, i + 1, i * i}));
    const PoolVector<std::array<std::uint64_t, 3>> copy = values;
    values.clear();
    values.shrink_to_fit();
    EXPECT_EQ(copy.size(), 100'000U);
    EXPECT_EQ(copy.back()[0], 99'999U);
}

}  // namespace
