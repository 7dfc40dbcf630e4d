// SPDX-License-Identifier: Apache-2.0
//
// LatticePoint: a point of the lattice, in units of its Lattice.
#pragma once

#include <array>
#include <compare>

#include <trisect/kernel/coordinate.h>

namespace trisect {

/// Coordinates in lattice units. Regular value type, ordered lexicographically. Without arithmetic,
/// see Coordinate.
struct LatticePoint {
    Coordinate x;
    Coordinate y;
    Coordinate z;

    [[nodiscard]] constexpr Coordinate operator[](int axis) const {
        return axis == 0 ? x : (axis == 1 ? y : z);
    }
    /// The coordinates as doubles, which they are.
    [[nodiscard]] constexpr std::array<double, 3> doubles() const {
        return {x.to_double(), y.to_double(), z.to_double()};
    }
    [[nodiscard]] constexpr bool is_whole() const {
        return x.is_whole() && y.is_whole() && z.is_whole();
    }
    friend constexpr bool operator==(const LatticePoint&, const LatticePoint&) = default;
    friend constexpr std::strong_ordering operator<=>(const LatticePoint& a,
                                                      const LatticePoint& b) = default;
};

}  // namespace trisect
