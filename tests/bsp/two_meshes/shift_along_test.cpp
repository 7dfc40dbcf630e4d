// SPDX-License-Identifier: Apache-2.0
//
// Shifts along given directions (shift_along.h).

#include <trisect/bsp/two_meshes/shift_along.h>

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::shift_along;
using Directions = std::vector<std::array<int, 3>>;

TEST(ShiftAlong, HasAPositiveProductWithEveryDirection) {
    const Directions directions{{0, 0, -1}, {-1, 1, -1}, {1, 0, -1}, {0, 1, 0}};
    const auto shift = shift_along(directions);
    ASSERT_TRUE(shift.has_value());
    for (const auto& d : directions) EXPECT_GT(shift->along(d), 0);
}

TEST(ShiftAlong, IsNoneWhereDirectionsExcludeEachOther) {
    EXPECT_FALSE(shift_along(Directions{{0, 1, 0}, {0, -1, 0}}).has_value());
    EXPECT_FALSE(shift_along(Directions{{1, 1, 0}, {-1, 1, 0}, {0, -1, 0}}).has_value());
    EXPECT_TRUE(shift_along(Directions{}).has_value());
}

}  // namespace
