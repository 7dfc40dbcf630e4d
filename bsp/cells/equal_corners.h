// SPDX-License-Identifier: Apache-2.0
//
// EqualCorners: corners of two meshes that are one vertex of a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trisect::detail {

/// Corners with the coordinates of a corner of the first one of two meshes, which stands for them.
struct EqualCorners {
    struct Pair {
        std::uint32_t corner = 0;  ///< of mesh `mesh`
        std::uint32_t first = 0;   ///< of the first mesh
        std::uint8_t mesh = 1;     ///< 0 where that has its own corner twice
    };
    std::vector<Pair> pairs;  ///< each corner once
};

}  // namespace trisect::detail
