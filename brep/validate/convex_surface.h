// SPDX-License-Identifier: Apache-2.0
//
// Local convexity of a closed surface of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/brep/validate/twins.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Whether the surface is plainly the boundary of a convex solid, seen from outside: then no two of
/// its triangles meet beyond the corners and edges that they share. Exact; false as well where a
/// corner lies within a face. Ends at the first edge that is not convex. O(n) where few edges meet
/// in a corner.
[[nodiscard]] bool is_convex_surface(std::span<const LatticePoint> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles,
                                     const Twins& twins);

}  // namespace trisect::detail
