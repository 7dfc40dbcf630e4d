// SPDX-License-Identifier: Apache-2.0
//
// Embedding test of a boundary: no self-intersection, and nested shells.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/brep/lattice_mesh.h>

namespace trisect {

/// True when the mesh bounds a solid and no two of its triangles meet beyond the corners and edges
/// that they share: then its winding numbers are 0 and 1, and no facet lies on another one.
///
/// Exact. Also false for what does not harm but would have to be looked at: edges of more than two
/// triangles, corners with several fans, corners inside edges; and when the answer would take more
/// than some hundred pairs a triangle. Cost: O(n log n) for ordinary meshes, about two
/// microseconds a triangle. \throw CancelledError, LimitError by the StopScope
[[nodiscard]] bool is_embedded(const LatticeMesh& mesh);

/// The same for a mesh that is known to bound a solid, but for places where it touches itself: no
/// one of these triangles meets any other beyond the corners and edges that they share.
[[nodiscard]] bool are_embedded(const LatticeMesh& mesh, std::span<const std::uint32_t> triangles);

}  // namespace trisect
