// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/coordinate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <compare>
#include <cstdint>
#include <type_traits>

#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/number/dyadic.h>

namespace {

using trisect::Coordinate;
using trisect::LatticePoint;

template <class T>
concept Subtractable = requires(T a, T b) {
    a - b;
};
template <class T>
concept Addable = requires(T a, T b) {
    a + b;
};

TEST(Coordinate, HasNoArithmetic) {
    EXPECT_FALSE(Subtractable<Coordinate>);
    EXPECT_FALSE(Addable<Coordinate>);
    EXPECT_FALSE(Subtractable<LatticePoint>);
    EXPECT_FALSE((std::is_convertible_v<double, Coordinate>));
    EXPECT_FALSE((std::is_convertible_v<Coordinate, double>));
    EXPECT_EQ(sizeof(LatticePoint), 24U);
}

TEST(Coordinate, HoldsIntegersBelowTheLimit) {
    for (const std::int64_t v : {std::int64_t{0}, std::int64_t{1}, trisect::coordinate_limit - 1})
        for (const std::int64_t x : {v, -v}) {
            EXPECT_EQ(Coordinate(x).to_integer(), x);
            EXPECT_EQ(Coordinate(x).to_double(), static_cast<double>(x));
            EXPECT_EQ((-Coordinate(x)).to_integer(), -x);
        }
}

TEST(Coordinate, RefusesIntegersBeyondTheLimit) {
    constexpr std::int64_t limit = trisect::coordinate_limit;
    static_assert(Coordinate(limit).to_double() == 0x1p53);  // a bound to compare with
    EXPECT_EQ(Coordinate(-limit).to_double(), -0x1p53);
    for (const std::int64_t v : {limit + 1, -limit - 1, INT64_MAX, INT64_MIN})
        EXPECT_THROW((void)Coordinate(v), trisect::Error);
}

TEST(Coordinate, IsAnIntegerOfSmallerUnits) {
    using trisect::detail::scaled_integer;
    EXPECT_EQ(scaled_integer(Coordinate(0.75), 2), 3);
    EXPECT_EQ(scaled_integer(Coordinate(-0.75), 73), -(trisect::Int128{3} << 71));
    EXPECT_EQ(scaled_integer(Coordinate(12), 0), 12);
    EXPECT_EQ(scaled_integer(Coordinate(0), 0), 0);
    EXPECT_THROW((void)scaled_integer(Coordinate(0.75), 1), trisect::Error);
}

TEST(Coordinate, IsTotallyOrdered) {
    EXPECT_LT(Coordinate(-3), Coordinate(2));
    EXPECT_GE(Coordinate(2), Coordinate(2));
    EXPECT_EQ(Coordinate(-3) <=> Coordinate(2), std::strong_ordering::less);
    EXPECT_EQ(Coordinate(2) <=> Coordinate(-3), std::strong_ordering::greater);
    EXPECT_EQ(Coordinate(2) <=> Coordinate(2), std::strong_ordering::equal);
    EXPECT_LT((LatticePoint{1, 2, 3}), (LatticePoint{1, 3, -5}));
}

TEST(Coordinate, HasOneZero) {
    EXPECT_EQ(Coordinate(-0.0).bits(), Coordinate(0).bits());
    EXPECT_EQ((-Coordinate(0)).bits(), Coordinate().bits());
    EXPECT_FALSE(std::signbit(Coordinate(-0.0).to_double()));
}

}  // namespace
