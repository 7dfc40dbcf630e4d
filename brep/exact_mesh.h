// SPDX-License-Identifier: Apache-2.0
//
// ExactMesh: a triangle mesh with exact corners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point.h>

namespace trisect {

/// The triangles of a boundary before anything is rounded.
///
/// Invariants: every index is less than points.size(); no triangle is degenerate; `source` has one
/// entry for each triangle. Orientation: counter-clockwise seen from outside.
struct ExactMesh {
    Lattice lattice;
    std::vector<Point> points;  ///< in lattice units
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<FaceSource> source;  ///< the face of an operand that a triangle is part of
};

/// The same triangles with correctly rounded coordinates in the user's units.
[[nodiscard]] PolygonMesh to_polygon_mesh(const ExactMesh& mesh);

}  // namespace trisect
