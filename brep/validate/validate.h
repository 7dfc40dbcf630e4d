// SPDX-License-Identifier: Apache-2.0
//
// Validation: the defects that keep a mesh from bounding a solid.
//
// A mesh bounds a solid when its faces are free of proper intersections, their boundaries cancel,
// and its shells are nested so that the winding number is 0 or 1 everywhere. Each reason why not is
// a Defect. Everything is decided exactly for the mesh on its lattice; points of equal value are
// one vertex, whatever their indices.
//
// What happens when things touch: faces that share corners or edges are neighbours. A corner in
// the inside of another face or edge, and edges that overlap on a line, are reported as FacesTouch,
// a warning, since a solid may touch itself there. An edge inside another face, faces that cross
// and coplanar faces that overlap are SelfIntersection.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/defect.h>

namespace trisect {

class Brep;

struct ValidateOptions {
    /// As in ImportOptions. The report has what rounding changed.
    std::optional<Lattice> lattice = std::nullopt;
    /// Defects listed of each kind; all are counted.
    std::size_t list_limit = 100;
    /// The one check that is not linear: O(n log n) for ordinary meshes.
    bool self_intersection = true;
    /// Pairs of triangles that check may look at before it gives up with a LimitError.
    std::uint64_t pair_limit = std::uint64_t{1} << 28;
    /// End when a defect of the faces was found, without the checks that come after it.
    bool until_first = false;
};

/// All checks. Indices in the report are those of the mesh (for equal points, the first one's).
/// \throw UsageError for indices out of range, LimitError for coordinates outside the lattice or
/// when pair_limit is reached.
[[nodiscard]] ValidationReport validate(const PolygonMesh& mesh,
                                        const ValidateOptions& options = {});
/// The same; faces are the mesh's triangles.
[[nodiscard]] ValidationReport validate(const LatticeMesh& mesh,
                                        const ValidateOptions& options = {});
/// What the invariants of Brep leave open: holes outside their faces.
[[nodiscard]] ValidationReport validate(const Brep& brep, const ValidateOptions& options = {});

}  // namespace trisect
