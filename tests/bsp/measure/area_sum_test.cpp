// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/measure/area_sum.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

#include <trisect/brep/measure/exact_values.h>

namespace area_sum_test {
namespace {

using trisect::Int128;
using trisect::WideInt;
using trisect::detail::AreaSum;

// The root of the vector's square, with 200 bits behind the point.
mpz_class exact_length(const std::array<Int128, 3>& v) {
    mpz_class square = 0;
    for (const Int128 c : v) {
        const mpz_class z = trisect::detail::to_integer(WideInt<3>(c));
        square += z * z;
    }
    return sqrt(mpz_class(square << 400));
}

mpz_class of_double(double v) {
    mpq_class q(v);
    q *= mpq_class(mpz_class(1) << 200);
    return q.get_num() / q.get_den();
}

void expect_enclosed(const AreaSum& sum, const mpz_class& exact) {
    const mpz_class off = abs(of_double(sum.sum().high) + of_double(sum.sum().low) - exact);
    EXPECT_LE(off, of_double(sum.error()) + 1);
}

TEST(AreaSum, OfSingleVectorsOfAllSizes) {
    std::mt19937_64 random(5);
    for (int bits = 1; bits <= 125; ++bits) {
        for (int n = 0; n < 20; ++n) {
            std::array<Int128, 3> v{};
            for (Int128& c : v) {
                const int shift = static_cast<int>(random() % static_cast<std::uint64_t>(bits));
                c = static_cast<Int128>(trisect::Uint128{random()} << 61 | random() >> 3) >>
                    (125 - bits) >> shift;
                if ((random() & 1) != 0) c = -c;
            }
            AreaSum sum;
            sum.add(v);
            expect_enclosed(sum, exact_length(v));
        }
    }
}

TEST(AreaSum, OfManyVectors) {
    std::mt19937_64 random(6);
    AreaSum sum;
    mpz_class exact = 0;
    for (int n = 0; n < 5000; ++n) {
        AreaSum one;
        std::array<Int128, 3> v{};
        for (Int128& c : v) c = static_cast<Int128>(random()) << (random() % 60);
        one.add(v);
        exact += exact_length(v);
        sum.add(one);
    }
    expect_enclosed(sum, exact);
    EXPECT_LT(sum.error(), 0x1p-80 * sum.sum().high);
}

TEST(AreaSum, OfNothing) {
    AreaSum sum;
    sum.add({0, 0, 0});
    EXPECT_EQ(sum.sum().high, 0);
    EXPECT_EQ(sum.error(), 0);
}

}  // namespace
}  // namespace area_sum_test
