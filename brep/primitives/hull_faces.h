// SPDX-License-Identifier: Apache-2.0
//
// Faces of a convex hull, of facets that share a plane.
#pragma once

#include <span>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/primitives/hull_facets.h>

namespace trisect::detail {

/// Each face cut into triangles anew, without corners where its outline goes straight on. Strips
/// from one end of a face to the other, not fans: where translates of a face overlap in its plane,
/// a triangle of a strip overlaps few of the other strip, a triangle of a fan many of the other
/// fan. Points are the corners that are left.
[[nodiscard]] LatticeMesh mesh_of_faces(std::span<const LatticePoint> points,
                                        std::span<const HullFacets::Facet> facets, Lattice lattice);

}  // namespace trisect::detail
