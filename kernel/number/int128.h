// SPDX-License-Identifier: Apache-2.0
//
// Signs, magnitudes and divisors of integers of 128 bits.
#pragma once

#include <bit>
#include <cstdint>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

[[nodiscard]] constexpr int sign(Int128 v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

/// \pre v > -2^127
[[nodiscard]] constexpr Int128 magnitude(Int128 v) { return v < 0 ? -v : v; }

[[nodiscard]] constexpr Uint128 unsigned_magnitude(Int128 v) {
    return v < 0 ? -static_cast<Uint128>(v) : static_cast<Uint128>(v);
}

[[nodiscard]] constexpr int trailing_zeros(Uint128 v) {
    const auto low = static_cast<std::uint64_t>(v);
    return low != 0 ? std::countr_zero(low)
                    : 64 + std::countr_zero(static_cast<std::uint64_t>(v >> 64));
}

/// The greatest common divisor, positive. \pre a and b are not 0 (Stein's algorithm).
[[nodiscard]] constexpr Int128 common_divisor(Int128 a, Int128 b) {
    Uint128 u = unsigned_magnitude(a);
    Uint128 v = unsigned_magnitude(b);
    const int twos = trailing_zeros(u | v);
    u >>= trailing_zeros(u);
    while (v != 0) {
        v >>= trailing_zeros(v);
        if (u > v) {
            const Uint128 t = u;
            u = v;
            v = t;
        }
        v -= u;
    }
    return static_cast<Int128>(u << twos);
}

/// \pre the number fits.
template <int N>
[[nodiscard]] constexpr Int128 to_int128(const WideInt<N>& v) {
    static_assert(N >= 2);
    return static_cast<Int128>(Uint128{v.limb(1)} << 64 | v.limb(0));
}

}  // namespace trisect::detail
