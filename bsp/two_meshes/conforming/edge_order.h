// SPDX-License-Identifier: Apache-2.0
//
// Half-planes around an edge, by exact signs.
#pragma once

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// The sign of det(a - d, b - d, c - d). Exact.
[[nodiscard]] int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                              const LatticePoint& d);

/// Whether two points of a plane through the line from `from` to `to` are on one side of the line.
/// \pre the four are in one plane, and neither point is on the line
[[nodiscard]] bool are_on_one_side(const LatticePoint& from, const LatticePoint& to,
                                   const LatticePoint& a, const LatticePoint& b);

/// Whether, turning counter-clockwise around an edge from half-plane a on, b comes before c. Given
/// are the signs of the turns from one to another, 0 where they are opposite. \pre three different
/// half-planes
[[nodiscard]] constexpr bool comes_between(int ab, int ac, int bc) {
    if (ac > 0) return ab > 0 && bc > 0;
    if (ac < 0) return ab >= 0 || bc > 0;
    return ab > 0;
}

}  // namespace trisect::detail
