// SPDX-License-Identifier: Apache-2.0
//
// InfinitesimalShift: the direction of an infinitesimal move of one of two meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

struct CornerMoves;

/// The second one of two meshes is moved by e along the first of these axes, e² along the second
/// one and e³ along the third one, with these signs. Before that it may grow about a centre by a
/// factor 1 + d, or shrink by 1 - d, with a d that is larger than all e, and then again about
/// another centre, with a d between those two. Or, in place of growth, each of its corners may move
/// by a vector of its own.
struct InfinitesimalShift {
    std::array<std::uint8_t, 3> axes{0, 1, 2};
    std::array<std::int8_t, 3> signs{1, 1, 1};  ///< in the order of `axes`
    std::int8_t growth = 0;                     ///< 1: it grows; -1: it shrinks
    LatticePoint centre;
    std::int8_t next_growth = 0;
    LatticePoint next_centre;
    const CornerMoves* moves = nullptr;

    /// The sign of the product of a vector and the move along the axes, by the signs of the
    /// vector's components; 0 for 0.
    [[nodiscard]] int along(const std::array<int, 3>& components) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (const int c = components[axes[k]]; c != 0) return c * signs[k];
        return 0;
    }
};

}  // namespace trisect::detail
