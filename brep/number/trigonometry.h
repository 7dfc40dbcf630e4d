// SPDX-License-Identifier: Apache-2.0
//
// Sines, cosines and angles of fractions, with proved error bounds.
// Values are integers over a power of two. They enclose motions of constant angular speed. No
// function of the C library is trusted.
#pragma once

#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// Numbers of this file stand for themselves times 2^fixed_bits. Every result, read that way, is
/// within 2^-fixed_error_bits of the exact value for exact arguments.
inline constexpr unsigned fixed_bits = 256;
inline constexpr unsigned fixed_error_bits = 150;

struct SineCosine {
    mpz_class sine;
    mpz_class cosine;
};

/// \pre |angle| <= 2^20 (radians)
[[nodiscard]] SineCosine sine_cosine(const mpq_class& angle);

/// The angle in (-pi, pi) of the direction (x, y). \pre not (0, 0), nor within 2^-40 of (-1, 0)
[[nodiscard]] mpq_class angle_of(const mpz_class& y, const mpz_class& x);

/// The nearest integer to v / 2^bits; halves go up.
[[nodiscard]] mpz_class shifted_down(const mpz_class& v, unsigned bits);

}  // namespace trisect::detail
