// SPDX-License-Identifier: Apache-2.0
//
// Conversions between the exact boundary and plain meshes.
#pragma once

#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect {

struct MeshOptions {
    /// False keeps a face with one loop as one polygon; faces with holes become triangles anyway.
    bool triangles = true;
};

/// What each polygon of a mesh was part of. Overwritten by to_polygon_mesh.
struct MeshMap {
    std::vector<FaceId> face;        ///< by polygon of the mesh
    std::vector<FaceSource> source;  ///< the same
};

/// The boundary with correctly rounded coordinates in the user's units.
///
/// Vertex v of the mesh is vertex v of the Brep, so copies at a contact stay apart; faces keep
/// their order. Every directed edge of the mesh occurs once, except where two copies of an edge
/// join the same vertices (see Brep): indices alone cannot distinguish those. Rounding can make
/// small faces degenerate or let them intersect: the connectivity is exact, the coordinates are the
/// nearest ones.
[[nodiscard]] PolygonMesh to_polygon_mesh(const Brep& brep, MeshOptions options = {},
                                          MeshMap* map = nullptr);

/// Each triangle becomes a face with the provenance {operand, mesh.face_of(triangle)}.
/// \throw Error InvalidSolid when the mesh is not closed or not oriented.
[[nodiscard]] Brep brep_from_lattice_mesh(const LatticeMesh& mesh, std::uint32_t operand = 0);

}  // namespace trisect
