// SPDX-License-Identifier: Apache-2.0
//
// LatticePoint: a point with integer coordinates, in units of its Lattice.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace trisect {

/// Largest number of bits of a coordinate: |coordinate| < 2^53, so that a double holds it exactly.
inline constexpr int coordinate_bits = 53;
inline constexpr std::int64_t coordinate_limit = std::int64_t{1} << coordinate_bits;

/// Coordinates in lattice units. Regular value type, ordered lexicographically.
struct LatticePoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    [[nodiscard]] constexpr std::int64_t operator[](int axis) const {
        return axis == 0 ? x : (axis == 1 ? y : z);
    }
    friend constexpr auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
    friend constexpr LatticePoint operator+(LatticePoint a, LatticePoint b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr LatticePoint operator-(LatticePoint a, LatticePoint b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
};

}  // namespace trisect
