// SPDX-License-Identifier: Apache-2.0
//
// Tessellation of curved boundaries within a stated deviation.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/brep/curved/curved_boundary.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect {

struct Tessellation {
    /// Closed triangles; neighbouring patches have the same vertices along their common side.
    /// Coordinates are multiples of 2^-44 of the power of two above the largest one, so that a
    /// lattice holds them without loss.
    PolygonMesh mesh;
    std::vector<std::uint32_t> patch_of_face;
    /// Certified: every point of the curved boundary is within this distance of the mesh, and every
    /// point of the mesh within it of the curved boundary. At most what was requested.
    double deviation = 0;
};

/// Each patch becomes a grid of cells fine enough for its second derivatives (after Filip, Magedson
/// and Markot 1986, by ranges of vectors instead of bounds on magnitudes), each cell two triangles;
/// cells along a side that the neighbour divides more finely
/// take over its vertices.
///
/// That the mesh does not pass through itself is not implied: surfaces nearer to each other than
/// twice the deviation may cross. `validate` finds out; a smaller deviation helps, unless the
/// curved boundary itself crosses.
///
/// \throw UsageError for a deviation that is not positive or finer than doubles can decide,
/// LimitError beyond 2^26 cells.
[[nodiscard]] Tessellation tessellate(const CurvedBoundary& boundary, double deviation);

}  // namespace trisect
