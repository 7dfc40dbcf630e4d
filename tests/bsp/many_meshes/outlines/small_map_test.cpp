// SPDX-License-Identifier: Apache-2.0
//
// A map that is emptied again and again (small_map.h).

#include <trisect/bsp/many_meshes/outlines/small_map.h>

#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace {

using trisect::detail::FlatMap;

void fill(FlatMap& map, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) map.insert({i, 0}, 1);
}

TEST(SmallMap, KeepsItsMemoryForAsManyAndGivesUpMore) {
    FlatMap map;
    fill(map, 1000);
    const std::size_t large = map.bytes();
    trisect::detail::empty(map);
    EXPECT_EQ(map.size(), 0U);
    EXPECT_EQ(map.find({1, 0}), -1);
    EXPECT_EQ(map.bytes(), large);
    fill(map, 3);
    trisect::detail::empty(map);
    EXPECT_LT(map.bytes(), large);
    fill(map, 5);
    EXPECT_EQ(map.size(), 5U);
    EXPECT_EQ(map.find({4, 0}), 1);
}

}  // namespace
