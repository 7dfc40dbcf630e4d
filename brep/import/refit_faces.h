// SPDX-License-Identifier: Apache-2.0
//
// Refitting: moving corners of nearly axis-aligned polygons into one plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Moves `points` (of the input, not welded) so that the corners of each of the mesh's non-planar
/// faces get the same coordinate along one axis, and returns the largest move in lattice units.
///
/// A face qualifies for an axis along which it extends by at most 2·max_move. Faces that share
/// corners and an axis are moved together, to the middle of their common range.
/// \throw UnsupportedError naming a face that does not qualify, or a group that extends too far.
std::int64_t refit_faces(const PolygonMesh& input, const PreparedMesh& mesh, std::int64_t max_move,
                         std::span<LatticePoint> points);

}  // namespace trisect::detail
