// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/number/digits.h>

#include <gtest/gtest.h>

#include <vector>

#include "support/gmp_oracle.h"

namespace {

using oracle::integer;
using oracle::register_of;
using trisect::Int128;
using trisect::WideInt;
using trisect::detail::add_product;
using trisect::detail::carried;
using trisect::detail::Columns;
using trisect::detail::Digits;
using trisect::detail::negate_if;
using trisect::detail::sign_of;
using trisect::detail::subtract_product;
using trisect::detail::to_digits;
using trisect::detail::to_wide_int;

template <int N>
mpz_class value(const Digits<N>& v) {
    mpz_class sum = 0;
    for (int i = N - 1; i >= 0; --i) sum = (sum << 56) + integer(v[i]);
    return sum;
}

// Random numbers of up to `bits` bits and the largest of that length.
std::vector<mpz_class> samples(mp_bitcnt_t bits, std::uint64_t seed) {
    const mpz_class largest = (mpz_class(1) << bits) - 1;
    std::vector<mpz_class> out{0, 1, -1, largest, -largest, mpz_class(1) << (bits - 1)};
    oracle::Source random(seed);
    for (int k = 0; k < 60; ++k) {
        mpz_class v = 0;
        for (int i = 0; i <= static_cast<int>(bits) / 64; ++i)
            v = (v << 64) + mpz_class(random.bits());
        v &= largest;
        v >>= random.below(bits);
        out.push_back(random.coin() ? v : mpz_class(-v));
    }
    return out;
}

template <int N, int M>
void check_round_trip(mp_bitcnt_t bits) {
    for (const mpz_class& v : samples(bits, 3)) {
        const auto digits = to_digits<N>(register_of<M>(v));
        EXPECT_EQ(value(digits), v);
        for (int i = 0; i + 1 < N; ++i) EXPECT_TRUE(digits[i] >= 0 && digits[i] < 1LL << 56);
        EXPECT_EQ(integer(to_wide_int<M>(digits)), v);
    }
}

TEST(Digits, RoundTripThroughWideInt) {
    check_round_trip<1, 1>(62);
    check_round_trip<2, 2>(117);
    check_round_trip<2, 3>(83);
    check_round_trip<3, 3>(163);
    check_round_trip<3, 6>(173);
    check_round_trip<4, 7>(229);
    check_round_trip<6, 6>(330);
    check_round_trip<7, 7>(384);
}

TEST(Digits, FromInt128) {
    for (const mpz_class& v : samples(109, 4)) {
        const WideInt<2> w = register_of<2>(v);
        const auto bits = (static_cast<trisect::Uint128>(w.limb(1)) << 64) | w.limb(0);
        EXPECT_EQ(value(to_digits<2>(static_cast<Int128>(bits))), v);
    }
}

TEST(Digits, SumsOfProductsAtTheirLargest) {
    // The widest sums of the predicates: minors, points and sides of both tiers.
    const auto normals = samples(109, 5);
    const auto offsets = samples(163, 6);
    const auto crosses = samples(219, 7);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            const auto c = to_digits<4>(register_of<4>(crosses[i]));
            const auto d = to_digits<3>(register_of<3>(offsets[k]));
            const auto n = to_digits<2>(register_of<2>(normals[k]));
            Columns<6> sum;
            for (int term = 0; term < 3; ++term) add_product(sum, c, d);
            EXPECT_EQ(value(carried<7>(sum)), 3 * crosses[i] * offsets[k]);
            subtract_product(sum, c, n);
            const mpz_class expected = 3 * crosses[i] * offsets[k] - crosses[i] * normals[k];
            EXPECT_EQ(value(carried<7>(sum)), expected);
            EXPECT_EQ(sign_of(sum), sgn(expected));
            negate_if(sum, true);
            EXPECT_EQ(value(carried<7>(sum)), -expected);
            negate_if(sum, false);
            EXPECT_EQ(sign_of(sum), -sgn(expected));
        }
    }
}

TEST(Digits, SignSeesTheLowestDigitOnly) {
    Columns<3> c;
    EXPECT_EQ(sign_of(c), 0);
    c[0] = 1;
    EXPECT_EQ(sign_of(c), 1);
    c[0] = -1;
    EXPECT_EQ(sign_of(c), -1);
    // 2^112 - 2^56 * 2^56 = 0, spread over the columns; then one less.
    c[0] = 0;
    c[1] = -(Int128{1} << 56);
    c[2] = 1;
    EXPECT_EQ(sign_of(c), 0);
    c[0] = -1;
    EXPECT_EQ(sign_of(c), -1);
}

}  // namespace
