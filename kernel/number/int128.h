// SPDX-License-Identifier: Apache-2.0
//
// Signs and magnitudes of integers of 128 bits.
#pragma once

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

[[nodiscard]] constexpr int sign(Int128 v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

/// \pre v > -2^127
[[nodiscard]] constexpr Int128 magnitude(Int128 v) { return v < 0 ? -v : v; }

[[nodiscard]] constexpr Uint128 unsigned_magnitude(Int128 v) {
    return v < 0 ? -static_cast<Uint128>(v) : static_cast<Uint128>(v);
}

/// \pre the number fits.
template <int N>
[[nodiscard]] constexpr Int128 to_int128(const WideInt<N>& v) {
    static_assert(N >= 2);
    return static_cast<Int128>(Uint128{v.limb(1)} << 64 | v.limb(0));
}

}  // namespace trisect::detail
