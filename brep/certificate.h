// SPDX-License-Identifier: Apache-2.0
//
// Certificate: the effect of rounding an exact result to doubles or floats.
//
// The result of a boolean has no self-intersection, but its corners are rounded to doubles (or to
// the floats of binary STL) and faces closer than that may then meet. Whether they do is decided
// exactly, on the coordinates as written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// Why nothing is known about self-intersection.
enum class Undecided : std::uint8_t {
    No,    ///< it is known
    Span,  ///< the written coordinates span too many bits for the exact check
    Work   ///< more pairs of faces are near each other than the check compares
};

struct Certificate {
    bool closed = false;    ///< the written faces' boundaries cancel
    bool oriented = false;  ///< and the volume they enclose is not negative
    /// Pairs of written faces that meet beyond the corners and edges they share, or have the same
    /// corners; nothing when that was not decided.
    std::optional<std::size_t> self_intersecting_pairs;
    Undecided undecided = Undecided::No;  ///< why it was not
    double max_move = 0;                  ///< largest change of one coordinate, user's units
    std::size_t rounded_vertices = 0;     ///< vertices with a changed coordinate

    /// The mesh bounds a solid, and this is proved.
    [[nodiscard]] bool holds() const {
        return closed && oriented && self_intersecting_pairs.value_or(1) == 0;
    }
};

/// How coordinates are written.
enum class Precision : std::uint8_t { Double, Float };

/// Of a mesh as it is; nothing is said about moves.
[[nodiscard]] Certificate certify(const PolygonMesh& mesh);

/// \pre `mesh` is to_polygon_mesh(brep): the same vertices. Costs a validation of the mesh, or some
/// 0.3 microseconds a triangle where the mesh is a manifold of triangles.
[[nodiscard]] Certificate certify(const Brep& brep, PolygonMesh mesh,
                                  Precision precision = Precision::Double);
/// \pre `mesh` is to_polygon_mesh(exact).
[[nodiscard]] Certificate certify(const ExactMesh& exact, PolygonMesh mesh,
                                  Precision precision = Precision::Double);

}  // namespace trisect
