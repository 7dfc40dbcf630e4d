// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/number/flat_corner.h>

#include <gtest/gtest.h>

#include <random>

#include "support/gmp_oracle.h"

namespace {

using trisect::detail::FlatCorner;

int oracle_turn(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    const auto x = [](trisect::Coordinate v) { return mpz_class(v.to_double()); };
    const mpz_class d =
        (x(b.u) - x(a.u)) * (x(c.v) - x(a.v)) - (x(b.v) - x(a.v)) * (x(c.u) - x(a.u));
    return sgn(d);
}

// Points of a line, some of them a unit off: most turns are beyond doubles.
TEST(FlatCorner, TurnsAreExact) {
    std::mt19937_64 random(20261123);
    int straight = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto number = [&](int bits) {
            const auto v = static_cast<std::int64_t>(random() >> (64 - bits));
            return (random() & 1U) != 0 ? v : -v;
        };
        const int bits = 1 + static_cast<int>(random() % 20);
        const std::int64_t du = number(bits);
        const std::int64_t dv = number(bits);
        const std::int64_t u = number(40);
        const std::int64_t v = number(40);
        const auto on_line = [&] {
            const std::int64_t t = number(30);
            return FlatCorner{u + t * du + number(1) * number(1), v + t * dv};
        };
        const FlatCorner a = on_line();
        const FlatCorner b = on_line();
        const FlatCorner c = on_line();
        const int expected = oracle_turn(a, b, c);
        straight += expected == 0 ? 1 : 0;
        ASSERT_EQ(turn(a, b, c), expected);
        ASSERT_EQ(exact_turn(a, b, c), expected);
        ASSERT_EQ(turn(b, a, c), -expected);
    }
    EXPECT_GT(straight, 1000);
}

// Values of turns, in integers and in doubles, and corners that coincide.
TEST(FlatCorner, ValuesOfTurns) {
    oracle::Source source(20261201);
    for (int round = 0; round < 20000; ++round) {
        const bool whole = source.coin();
        const auto number = [&] {
            return whole ? trisect::Coordinate(source.coordinate(53))
                         : trisect::Coordinate(source.fraction(53, trisect::fraction_limit));
        };
        const FlatCorner a{number(), number()};
        const FlatCorner b{number(), number()};
        const FlatCorner c{source.below(3) == 0 ? a.u : number(),
                           source.below(3) == 0 ? b.v : number()};
        const auto x = [](trisect::Coordinate v) { return mpq_class(v.to_double()); };
        const mpq_class exact =
            (x(b.u) - x(a.u)) * (x(c.v) - x(a.v)) - (x(b.v) - x(a.v)) * (x(c.u) - x(a.u));
        const mpz_class unit = mpz_class(1) << (2 * trisect::fraction_limit);
        ASSERT_EQ(mpq_class(oracle::integer(turn_of_fractions(a, b, c))), exact * unit);
        if (whole) {
            ASSERT_EQ(mpq_class(oracle::integer(turn_of_integers(a, b, c))), exact);
        }
        const auto rounded = rounded_turn(a, b, c);
        ASSERT_LE(abs(mpq_class(rounded.value) - exact), mpq_class(rounded.error));
        ASSERT_EQ(turn(a, b, c), sgn(exact));
        ASSERT_EQ(turn(a, b, a), 0);
        ASSERT_EQ(turn(a, b, b), 0);
    }
}

}  // namespace
