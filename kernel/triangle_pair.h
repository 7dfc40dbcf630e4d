// SPDX-License-Identifier: Apache-2.0
//
// Intersection test of two triangles, from orientations of their corners alone.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

enum class TrianglePair : std::uint8_t {
    Disjoint,
    Crossing,  ///< interiors meet along a segment
    Unknown    ///< doubles cannot decide, or they touch
};

/// A triangle, and on which side of the other one's support its corners lie: -1 below, 1 above.
struct SidedTriangle {
    std::array<LatticePoint, 3> corners;
    std::array<int, 3> sides;
};

/// \pre no corner lies on the other triangle's support, and both triangles straddle it. The
/// supports are those of the corners in their order. About 30 ns.
///
/// Source: Guigue and Devillers, "Fast and robust triangle-triangle overlap test using orientation
/// predicates", 2003.
[[nodiscard]] TrianglePair relate_triangles(const SidedTriangle& a, const SidedTriangle& b);

}  // namespace trisect::detail
