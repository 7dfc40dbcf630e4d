// SPDX-License-Identifier: Apache-2.0
//
// Room that is touched beforehand (touched_room.h): values stay what they are.

#include <trisect/kernel/support/touched_room.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/kernel/support/pool_allocator.h>

namespace {

TEST(TouchedRoom, ValuesStay) {
    for (const std::uint32_t threads : {0U, 1U, 3U})
        for (const std::size_t more : {std::size_t{0}, std::size_t{10}, std::size_t{3} << 20}) {
            trisect::detail::PoolVector<std::uint32_t> values(1000);
            std::iota(values.begin(), values.end(), 0U);
            trisect::detail::reserve_touched(values, more, threads);
            EXPECT_GE(values.capacity(), 1000 + more);
            const std::uint32_t* const at = values.data();
            values.resize(1000 + more, 7);
            EXPECT_EQ(values.data(), at);
            for (std::uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(values[i], i);
        }
}

}  // namespace
