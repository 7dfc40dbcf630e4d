// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/coordinate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <compare>
#include <cstdint>
#include <type_traits>

#include <trisect/kernel/lattice_point.h>

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
