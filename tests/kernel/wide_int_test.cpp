// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/wide_int.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/gmp_oracle.h"

namespace {

using oracle::integer;
using oracle::register_of;
using trisect::Int128;
using trisect::multiply;
using trisect::WideInt;

// Values that sit on the edges of limbs and of the register, and random ones of every length.
template <int N>
std::vector<WideInt<N>> samples(std::uint64_t seed, int count) {
    std::vector<WideInt<N>> out;
    for (const int at : {0, 1, 31, 32, 52, 53, 54, 63, 64, 65, 127, 128, 64 * N - 2, 64 * N - 1}) {
        if (at >= 64 * N) continue;
        const mpz_class power = mpz_class(1) << static_cast<mp_bitcnt_t>(at);
        for (int offset = -1; offset <= 1; ++offset) {
            out.push_back(register_of<N>(power + offset));
            out.push_back(register_of<N>(-power + offset));
        }
    }
    oracle::Source random(seed);
    for (int k = 0; k < count; ++k) {
        mpz_class v = 0;
        for (int i = 0; i < N; ++i) v = (v << 64) + mpz_class(random.bits());
        v >>= random.below(64 * N);
        out.push_back(register_of<N>(random.coin() ? v : mpz_class(-v)));
    }
    return out;
}

// The value that a register of N limbs keeps of v.
template <int N>
mpz_class wrapped(const mpz_class& v) {
    return integer(register_of<N>(v));
}

template <int N>
void check_arithmetic() {
    const auto values = samples<N>(N, 60);
    for (const auto& a : values) {
        const mpz_class x = integer(a);
        EXPECT_EQ(integer(-a), wrapped<N>(-x));
        EXPECT_EQ(a.sign(), sgn(x));
        EXPECT_EQ(a.is_negative(), x < 0);
        EXPECT_EQ(a.is_zero(), x == 0);
        EXPECT_EQ(integer(a.abs()), wrapped<N>(abs(x)));
        for (const auto& b : values) {
            const mpz_class y = integer(b);
            EXPECT_EQ(integer(a + b), wrapped<N>(x + y));
            EXPECT_EQ(integer(a - b), wrapped<N>(x - y));
            EXPECT_EQ(a == b, x == y);
            EXPECT_EQ(a < b, x < y);
            EXPECT_EQ(a > b, x > y);
            EXPECT_EQ(a <= b, x <= y);
            EXPECT_EQ(a >= b, x >= y);
            EXPECT_EQ(a != b, x != y);
        }
    }
}

TEST(WideInt, Arithmetic) {
    check_arithmetic<1>();
    check_arithmetic<2>();
    check_arithmetic<3>();
    check_arithmetic<4>();
    check_arithmetic<7>();
    check_arithmetic<8>();
    check_arithmetic<13>();
}

template <int R, int A, int B>
void check_product() {
    const auto left = samples<A>(10 * A, 40);
    const auto right = samples<B>(10 * B + 1, 40);
    for (const auto& a : left)
        for (const auto& b : right)
            ASSERT_EQ(integer(multiply<R>(a, b)), wrapped<R>(integer(a) * integer(b)))
                << integer(a) << " * " << integer(b) << " in " << R << " limbs";
}

TEST(WideInt, Products) {
    check_product<2, 1, 1>();
    check_product<3, 2, 1>();
    check_product<4, 2, 2>();
    check_product<5, 3, 2>();
    check_product<6, 4, 2>();
    check_product<7, 4, 3>();
    check_product<8, 7, 2>();
    check_product<13, 7, 6>();
}

TEST(WideInt, ProductsKeepTheLowLimbsOfATooLargeResult) {
    check_product<1, 1, 1>();
    check_product<1, 3, 2>();
    check_product<2, 3, 2>();
    check_product<4, 3, 4>();
    check_product<4, 8, 8>();
}

TEST(WideInt, ProductsExtendTheSignIntoAWideResult) {
    check_product<4, 1, 1>();
    check_product<9, 2, 3>();
    check_product<7, 7, 1>();
}

TEST(WideInt, ConstructionFromBuiltInIntegers) {
    EXPECT_EQ(integer(WideInt<4>(-5)), -5);
    EXPECT_EQ(integer(WideInt<1>(7)), 7);
    const std::int64_t lowest = INT64_MIN;
    EXPECT_EQ(integer(WideInt<3>(lowest)), mpz_class(-1) << 63);
    const Int128 big = Int128{1} << 126;
    EXPECT_EQ(integer(WideInt<2>(big)), mpz_class(1) << 126);
    EXPECT_EQ(integer(WideInt<5>(-big)), -(mpz_class(1) << 126));
    EXPECT_EQ(integer(WideInt<5>(-big - big)), -(mpz_class(1) << 127));
    EXPECT_EQ(integer(WideInt<1>(big + 3)), 3);
}

TEST(WideInt, WideningKeepsTheValueAndNarrowingTheLowLimbs) {
    for (const auto& a : samples<3>(5, 100)) {
        EXPECT_EQ(integer(WideInt<8>(a)), integer(a));
        EXPECT_EQ(WideInt<3>(WideInt<8>(a)), a);
        EXPECT_EQ(integer(WideInt<2>(a)), wrapped<2>(integer(a)));
        EXPECT_EQ(integer(WideInt<3>(a)), integer(a));
    }
}

TEST(WideInt, ShiftedLeft) {
    for (const auto& a : samples<4>(6, 50))
        for (const int bits : {0, 1, 7, 63, 64, 65, 127, 128, 200, 255})
            EXPECT_EQ(integer(a.shifted_left(bits)),
                      wrapped<4>(integer(a) << static_cast<mp_bitcnt_t>(bits)));
}

template <int N>
void check_length_and_double() {
    for (const auto& a : samples<N>(7, 500)) {
        const mpz_class x = integer(a);
        if (x == -(mpz_class(1) << (64 * N - 1))) continue;  // has no absolute value
        const std::size_t bits = x == 0 ? 0 : mpz_sizeinbase(x.get_mpz_t(), 2);
        EXPECT_EQ(a.bit_length(), static_cast<int>(bits));
        const mpz_class error = abs(mpz_class(a.to_double()) - x);
        EXPECT_LE(error << 52, abs(x)) << x;
        if (bits <= 53) {
            EXPECT_EQ(error, 0);
        }
    }
}

TEST(WideInt, BitLengthAndDouble) {
    check_length_and_double<1>();
    check_length_and_double<2>();
    check_length_and_double<3>();
    check_length_and_double<7>();
    check_length_and_double<8>();
}

TEST(WideInt, IsUsableInConstantExpressions) {
    constexpr WideInt<3> a = multiply<3>(WideInt<2>(-3), WideInt<1>(INT64_MAX)) + WideInt<3>(5);
    static_assert(a.is_negative());
    static_assert((a - a).is_zero());
    static_assert(WideInt<2>(1).shifted_left(100).bit_length() == 101);
    EXPECT_EQ(integer(a), mpz_class(INT64_MAX) * -3 + 5);
}

}  // namespace
