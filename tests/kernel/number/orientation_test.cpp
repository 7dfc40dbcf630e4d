// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/number/orientation.h>

#include <gtest/gtest.h>

#include <cmath>

#include "support/gmp_oracle.h"

namespace {

using trisect::detail::determinant_of_fractions;
using trisect::detail::exact_orientation_of_fractions;
using trisect::detail::product_of_fractions;
using trisect::detail::Vector3;

mpq_class oracle_determinant(const Vector3& a, const Vector3& b, const Vector3& c,
                             const Vector3& d) {
    const auto from_d = [&](const Vector3& p, std::size_t k) -> mpq_class {
        return mpq_class(p[k]) - mpq_class(d[k]);
    };
    mpq_class sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        sum += from_d(a, k) * (from_d(b, i) * from_d(c, j) - from_d(b, j) * from_d(c, i));
    }
    return sum;
}
int oracle_orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return sgn(oracle_determinant(a, b, c, d));
}

// Off by less than 2^-51 of it, and 0 where it is.
void expect_near(double value, const mpq_class& exact) {
    const mpq_class off = abs(mpq_class(value) - exact);
    EXPECT_LE(off, abs(exact) * mpq_class(0x1p-51));
}

// Of few and of many bits, so that both widths of integers are taken.
TEST(Orientation, OfFractionsIsExact) {
    oracle::Source source(20261129);
    int decided = 0;
    for (int round = 0; round < 20000; ++round) {
        const int bits = 1 + static_cast<int>(source.below(53));
        const int behind = static_cast<int>(source.below(trisect::fraction_limit));
        const auto point = [&] {
            Vector3 p{};
            for (double& v : p) v = source.fraction(bits, behind);
            return p;
        };
        const Vector3 a = point();
        const Vector3 b = point();
        const Vector3 c = point();
        const Vector3 d = point();
        const auto sign = exact_orientation_of_fractions(a, b, c, d);
        if (!sign) continue;
        ++decided;
        ASSERT_EQ(*sign, oracle_orientation(a, b, c, d)) << round;
        const auto value = determinant_of_fractions(a, b, c, d);
        ASSERT_TRUE(value);
        expect_near(*value, oracle_determinant(a, b, c, d));
        const auto product =
            product_of_fractions({{{a[0], a[1]}, {b[0], b[1]}}}, {{{c[0], c[1]}, {d[0], d[1]}}});
        ASSERT_TRUE(product);
        const auto along = [](const Vector3& from, const Vector3& to, std::size_t k) -> mpq_class {
            return mpq_class(to[k]) - mpq_class(from[k]);
        };
        expect_near(*product, along(a, b, 0) * along(c, d, 1) - along(a, b, 1) * along(c, d, 0));
    }
    EXPECT_GT(decided, 19000);
}

// A plane through three of them, and one in it but for the last bit of a coordinate.
TEST(Orientation, OfFractionsThatAreNearlyInOnePlane) {
    oracle::Source source(20261130);
    int flat = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto small = [&] {
            return std::ldexp(static_cast<double>(source.coordinate(24)), -30);
        };
        const Vector3 d{small(), small(), small()};
        Vector3 u{};
        Vector3 v{};
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = std::ldexp(static_cast<double>(source.coordinate(10)), -40);
            v[k] = std::ldexp(static_cast<double>(source.coordinate(10)), -40);
        }
        const auto at = [&](int s, int t) {
            Vector3 p = d;
            for (std::size_t k = 0; k < 3; ++k) p[k] += s * u[k] + t * v[k];
            return p;
        };
        const auto number = [&] { return static_cast<int>(source.below(7)) - 3; };
        const Vector3 a = at(number(), number());
        const Vector3 b = at(number(), number());
        Vector3 c = at(number(), number());
        if (source.coin()) c[0] = std::nextafter(c[0], 1);
        const auto sign = exact_orientation_of_fractions(a, b, c, d);
        ASSERT_TRUE(sign);
        ASSERT_EQ(*sign, oracle_orientation(a, b, c, d)) << round;
        EXPECT_EQ(*determinant_of_fractions(a, b, c, d) == 0, *sign == 0);
        flat += *sign == 0 ? 1 : 0;
    }
    EXPECT_GT(flat, 5000);
}

TEST(Orientation, OfCoordinatesThatSpanTooManyBitsIsLeftOpen) {
    const Vector3 a{0x1p60, 0, 0};
    const Vector3 b{0, 1, 0};
    const Vector3 c{0, 0, 1};
    EXPECT_EQ(exact_orientation_of_fractions(a, b, c, {0x1p-60, 0, 0}), 1);
    EXPECT_EQ(exact_orientation_of_fractions(a, b, c, {0x1p-70, 0, 0}), std::nullopt);
    EXPECT_EQ(determinant_of_fractions(a, b, c, {0x1p-70, 0, 0}), std::nullopt);
    EXPECT_EQ(determinant_of_fractions(a, a, c, c), 0.0);
    EXPECT_EQ(product_of_fractions({{{0x1p60, 0}, {0, 0}}}, {{{0x1p-70, 0}, {0, 1}}}),
              std::nullopt);
}

}  // namespace
