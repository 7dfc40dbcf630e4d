// SPDX-License-Identifier: Apache-2.0
//
// Moves of corners by which all facets of a mesh go outwards.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/shift/corner_moves.h>

namespace trisect::detail {

/// Moves of the corners of these facets, each along the normals of all of these facets that it is a
/// corner of, or against them all where `inwards`. Found in doubles: the search that uses them
/// shows whether they do. A corner for which there is none goes somewhere; others stay. O(n).
[[nodiscard]] std::shared_ptr<const CornerMoves> outward_moves(
    const LatticeMesh& mesh, std::span<const std::uint32_t> facets, bool inwards);

}  // namespace trisect::detail
