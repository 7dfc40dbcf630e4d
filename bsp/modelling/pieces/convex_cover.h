// SPDX-License-Identifier: Apache-2.0
//
// Convex bodies between corners of a boundary.
//
// Sums with a solid take the sum of each body in place of those of its triangles: a frame has four
// bodies and 32 triangles. Nothing is cut, so no corner is new.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/brep/lattice_mesh.h>

namespace trisect::detail {

/// Where bodies lie.
enum class CoverSide : std::uint8_t { Inside, Outside };

struct ConvexCover {
    /// The corners of each body; those of a triangle, or of a convex part of a face, where a body
    /// would be flat. All lie in the closure of the side.
    std::vector<std::vector<std::uint32_t>> bodies;
    /// Whether they are all of the inside. False also where that is not found out.
    bool fills = false;
};

/// Bodies that hold all triangles of a boundary. How many there are is no minimum. At most some
/// thousands of sides of points for each triangle: bodies end growing where it would take more.
/// \pre the mesh is embedded \throw CancelledError, LimitError of StopScope
[[nodiscard]] ConvexCover convex_cover(const LatticeMesh& mesh, CoverSide side);

}  // namespace trisect::detail
