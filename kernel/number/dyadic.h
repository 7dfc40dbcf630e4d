// SPDX-License-Identifier: Apache-2.0
//
// Doubles as integers times powers of two.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// mantissa · 2^exponent with an odd mantissa; 0 · 2^0 for 0.
struct Dyadic {
    std::int64_t mantissa = 0;
    int exponent = 0;
};

/// The double, exactly. \pre finite.
[[nodiscard]] constexpr Dyadic dyadic(double v) {
    if (v == 0) return {};
    constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;
    const auto bits = std::bit_cast<std::uint64_t>(v);
    const auto biased = static_cast<int>(bits >> 52 & 0x7ffU);
    const std::uint64_t m = (bits & fraction) | (biased == 0 ? 0 : fraction + 1);
    const int zeros = std::countr_zero(m);
    const auto odd = static_cast<std::int64_t>(m >> zeros);
    return {v < 0 ? -odd : odd, std::max(biased, 1) - 1075 + zeros};
}

/// The least e with |v| < 2^e. \pre finite, not 0.
[[nodiscard]] constexpr int exponent_above(double v) {
    const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 52 & 0x7ffU);
    return std::max(biased, 1) - 1022;
}

/// The bits behind the point: the least n >= 0 for which c 2^n is an integer.
[[nodiscard]] constexpr int fraction_bits(Coordinate c) {
    return c.is_whole() ? 0 : -dyadic(c.to_double()).exponent;
}
[[nodiscard]] constexpr int fraction_bits(const LatticePoint& p) {
    return std::max(fraction_bits(p.x), std::max(fraction_bits(p.y), fraction_bits(p.z)));
}

/// c 2^bits, exactly. \pre fraction_bits(c) <= bits <= fraction_limit.
[[nodiscard]] constexpr Int128 scaled_integer(Coordinate c, int bits) {
    const Dyadic d = dyadic(c.to_double());
    TRISECT_EXPECTS(d.exponent + bits >= 0, "a coordinate with more bits behind the point");
    return Int128{d.mantissa} * (Int128{1} << (d.exponent + bits));
}

}  // namespace trisect::detail
