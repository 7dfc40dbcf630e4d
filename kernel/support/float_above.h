// SPDX-License-Identifier: Apache-2.0
//
// Rounding a double up to a float.
#pragma once

#include <bit>
#include <cstdint>

namespace trisect::hierarchies {

/// The least float that is not below v. Without a branch: whether rounding to nearest went down is
/// a coin's toss, and volumes are rounded by the hundred thousand.
[[nodiscard]] inline float float_above(double v) {
    const auto nearest = static_cast<float>(v);
    const auto bits = std::bit_cast<std::uint32_t>(nearest);
    const auto below = static_cast<std::uint32_t>(static_cast<double>(nearest) < v);
    // The next float is one bit pattern on, or one back where there is a sign.
    return std::bit_cast<float>(bits + below - 2 * (below & (bits >> 31U)));
}

}  // namespace trisect::hierarchies
