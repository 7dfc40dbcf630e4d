// SPDX-License-Identifier: Apache-2.0
//
// Signs of four points, and the order of half-planes around an edge, against angles.

#include <trisect/bsp/two_meshes/conforming/edge_order.h>

#include <cmath>

#include <gtest/gtest.h>

namespace {

using trisect::Coordinate;
using trisect::LatticePoint;
using trisect::detail::are_on_one_side;
using trisect::detail::comes_between;
using trisect::detail::orientation;

LatticePoint at(double x, double y, double z) {
    return {Coordinate(x), Coordinate(y), Coordinate(z)};
}

TEST(EdgeOrder, HasTheSignsOfAngles) {
    // Sixteen directions around the z axis, so that some are opposite.
    constexpr int count = 16;
    const auto sign_of = [](int from, int to) {
        const int turn = (to - from + count) % count;
        return turn == 0 || turn == count / 2 ? 0 : (turn < count / 2 ? 1 : -1);
    };
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b)
            for (int c = 0; c < count; ++c) {
                if (a == b || b == c || a == c) continue;
                const bool expected = (b - a + count) % count < (c - a + count) % count;
                EXPECT_EQ(comes_between(sign_of(a, b), sign_of(a, c), sign_of(b, c)), expected)
                    << a << ' ' << b << ' ' << c;
            }
}

TEST(EdgeOrder, TurnsCounterClockwiseSeenAgainstTheEdge) {
    const LatticePoint from = at(0, 0, 0);
    const LatticePoint to = at(0, 0, 5);
    EXPECT_EQ(orientation(to, at(1, 0, 2), at(0, 1, -3), from), 1);
    EXPECT_EQ(orientation(to, at(0, 1, 2), at(1, 0, 7), from), -1);
    EXPECT_EQ(orientation(to, at(1, 0, 2), at(-3, 0, 1), from), 0);
}

TEST(Orientation, IsExact) {
    // A plane through three points, and a point that is off it by the last bit.
    const double far = 0x1p52;
    const double one = std::ldexp(1.0, -60);
    EXPECT_EQ(orientation(at(0, 0, 0), at(far, 0, 0), at(0, far, 0), at(far, far, 0)), 0);
    EXPECT_EQ(orientation(at(0, 0, 0), at(far, 0, 0), at(0, far, 0), at(1, 1, one)), -1);
    EXPECT_EQ(orientation(at(0, 0, 0), at(far, 0, 0), at(0, far, 0), at(1, 1, -one)), 1);
}

TEST(AreOnOneSide, SaysSoInAnyPlane) {
    EXPECT_TRUE(are_on_one_side(at(0, 0, 0), at(0, 0, 9), at(0, 1, 3), at(0, 7, -30)));
    EXPECT_FALSE(are_on_one_side(at(0, 0, 0), at(0, 0, 9), at(0, 1, 3), at(0, -7, -30)));
    EXPECT_TRUE(are_on_one_side(at(1, 2, 3), at(2, 4, 6), at(2, 3, 3), at(9, 16, 21)));
    EXPECT_FALSE(are_on_one_side(at(1, 2, 3), at(2, 4, 6), at(2, 3, 3), at(0, 1, 3)));
}

}  // namespace
