// SPDX-License-Identifier: Apache-2.0
//
// DoubleBox: a closed box of doubles.
#pragma once

#include <array>
#include <cstddef>

namespace trisect::detail {

/// Its ends may be infinite.
struct DoubleBox {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    [[nodiscard]] bool overlaps(const DoubleBox& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] > b.hi[k] || hi[k] < b.lo[k]) return false;
        return true;
    }
};

}  // namespace trisect::detail
