// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/half_spaces/parallel_planes.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace {

using trisect::Plane;
using trisect::detail::PlaneSide;
using trisect::detail::tight_sides;
using Sides = std::optional<std::vector<std::size_t>>;

// factor (x + 2 y - 3 z) <= factor times height, or >= where it is above.
PlaneSide side(std::int64_t factor, std::int64_t height, bool below = true) {
    return {Plane(factor, 2 * factor, -3 * factor, Plane::Coefficient(-factor * height)), below};
}

Sides numbers(std::vector<std::size_t> n) { return n; }

TEST(ParallelPlanes, TheTighterOfTwoThatLookAlike) {
    EXPECT_EQ(tight_sides(std::vector{side(1, 5)}), numbers({0}));
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), side(1, 4)}), numbers({1}));
    EXPECT_EQ(tight_sides(std::vector{side(7, 4), side(1, 5)}), numbers({0}));
    EXPECT_EQ(tight_sides(std::vector{side(1, 5, false), side(3, 4, false)}), numbers({0}));
    // The other orientation, and the other side of it.
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), side(-2, 4, false)}), numbers({1}));
}

TEST(ParallelPlanes, TwoThatFaceEachOther) {
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), side(2, 4, false)}), numbers({0, 1}));
    EXPECT_EQ(tight_sides(std::vector{side(-1, 4), side(2, 5)}), numbers({0, 1}));
    EXPECT_EQ(tight_sides(std::vector{side(1, 9), side(-1, 2), side(5, 7), side(1, 3, false)}),
              numbers({2, 3}));
}

TEST(ParallelPlanes, NothingIsBetween) {
    EXPECT_EQ(tight_sides(std::vector{side(1, 4), side(2, 5, false)}), std::nullopt);
    EXPECT_EQ(tight_sides(std::vector{side(1, 4), side(1, 8), side(2, 5, false)}), std::nullopt);
}

TEST(ParallelPlanes, TheSamePlaneOrOthers) {
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), side(3, 5)}), std::nullopt);
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), side(-3, 5)}), std::nullopt);
    const PlaneSide other{Plane(1, 2, -2, Plane::Coefficient(0)), true};
    EXPECT_EQ(tight_sides(std::vector{side(1, 5), other}), std::nullopt);
}

// The products have some 490 bits.
TEST(ParallelPlanes, LongCoefficients) {
    const Plane::Coefficient large =
        trisect::multiply<6>(trisect::WideInt<3>(trisect::Int128{1} << 120),
                             trisect::WideInt<3>(trisect::Int128{3} << 120));
    const auto below = [&](std::int64_t offset) {
        return PlaneSide{Plane(large, -large, large, large + Plane::Coefficient(offset)), true};
    };
    EXPECT_EQ(tight_sides(std::vector{below(1), below(0)}), numbers({0}));
    EXPECT_EQ(tight_sides(std::vector{below(-1), below(0)}), numbers({1}));
    EXPECT_EQ(tight_sides(std::vector{below(0), below(0)}), std::nullopt);
}

}  // namespace
