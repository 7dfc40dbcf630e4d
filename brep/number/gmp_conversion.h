// SPDX-License-Identifier: Apache-2.0
//
// Conversions between numbers of the public headers and GMP's.
// Public headers do not include GMP.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// The value of a fraction.
[[nodiscard]] mpq_class to_gmp(const ExactRational& value);
[[nodiscard]] ExactRational from_gmp(const mpq_class& value);

template <int N>
[[nodiscard]] mpz_class to_gmp(const WideInt<N>& value) {
    const WideInt<N> magnitude = value.abs();
    std::array<std::uint64_t, static_cast<std::size_t>(N)> limbs{};
    for (int i = 0; i < N; ++i) limbs[static_cast<std::size_t>(i)] = magnitude.limb(i);
    mpz_class z;
    mpz_import(z.get_mpz_t(), limbs.size(), -1, sizeof limbs[0], 0, 0, limbs.data());
    if (value.is_negative()) z = -z;
    return z;
}
[[nodiscard]] inline mpz_class to_gmp(Int128 value) { return to_gmp(WideInt<2>(value)); }
[[nodiscard]] inline mpz_class to_gmp(std::int64_t value) {
    // GMP takes long, which has 32 bits on some machines.
    if constexpr (sizeof(long) == sizeof(std::int64_t)) return mpz_class(static_cast<long>(value));
    return to_gmp(WideInt<1>(value));
}

/// Its digits of 64 bits, the lowest first; none for 0.
[[nodiscard]] std::vector<std::uint64_t> limbs_of(const mpz_class& magnitude);
/// A number in the range of the result.
[[nodiscard]] inline std::int64_t to_int64(const mpz_class& value) {
    if constexpr (sizeof(long) == sizeof(std::int64_t)) return value.get_si();
    const std::vector<std::uint64_t> limbs = limbs_of(value);
    const std::uint64_t magnitude = limbs.empty() ? 0 : limbs.front();
    return static_cast<std::int64_t>(sgn(value) < 0 ? ~magnitude + 1 : magnitude);
}

/// The fractions times the least common multiple of their denominators, which is `denominator`.
[[nodiscard]] std::vector<mpz_class> common_numerators(std::span<const mpq_class> values,
                                                       mpz_class& denominator);

}  // namespace trisect::detail
