// SPDX-License-Identifier: Apache-2.0
//
// Certificate: what rounding did to an exact result when it became a file.
//
// The result of a boolean has no self-intersection, but its corners are rounded to doubles (or to
// the floats of binary STL) and faces closer than that may then meet. Whether they do is decided
// exactly, on the coordinates as written.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/polygon_mesh.h>

#include <cstddef>
#include <optional>
#include <string>

#include "outcome.h"

namespace trisect::app {

struct Certificate {
    bool closed = false;    ///< the written faces' boundaries cancel
    bool oriented = false;  ///< and the volume they enclose is not negative
    /// Pairs of written faces that meet beyond the corners and edges they share; nothing when the
    /// written coordinates span too many bits for an exact check.
    std::optional<std::size_t> self_intersecting_pairs;
    double max_move = 0;               ///< largest change of one coordinate, user's units
    std::size_t rounded_vertices = 0;  ///< vertices with a changed coordinate
};

/// \pre `mesh` is to_polygon_mesh(brep): the same vertices. Costs a validation of the mesh.
[[nodiscard]] Certificate certify(const Brep& brep, PolygonMesh mesh, MeshFormat format);

[[nodiscard]] Json to_json(const Certificate& certificate);
[[nodiscard]] std::string to_text(const Certificate& certificate);

}  // namespace trisect::app
