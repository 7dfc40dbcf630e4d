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

}  // namespace trisect::detail
