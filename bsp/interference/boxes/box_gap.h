// SPDX-License-Identifier: Apache-2.0
//
// Lower bound on the distance between two boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::hierarchies {

/// Never more than the distance of any point of one from any point of the other: differences,
/// squares, sums and the root have a relative error of 2^-53 each, an underflow only makes it less.
[[nodiscard]] inline double gap_between(const detail::BodyBox& a, const detail::BodyBox& b) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = std::max({a.lo[k] - b.hi[k], b.lo[k] - a.hi[k], 0.0});
        square += d * d;
    }
    return std::sqrt(square) * (1 - 0x1p-48);
}

}  // namespace trisect::hierarchies
