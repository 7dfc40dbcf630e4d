// SPDX-License-Identifier: Apache-2.0
//
// Powers of two as doubles.
// A product with one rounds like std::ldexp and is many times faster.
#pragma once

#include <bit>
#include <cstdint>

namespace trisect::detail {

/// Whether 2^e is a normal double.
[[nodiscard]] constexpr bool is_normal_exponent(int e) { return e >= -1022 && e <= 1023; }

/// \pre is_normal_exponent(e)
[[nodiscard]] constexpr double power_of_two(int e) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
}

}  // namespace trisect::detail
