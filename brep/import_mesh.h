// SPDX-License-Identifier: Apache-2.0
//
// Import: conversion of polygons to triangles on a lattice.
// Everything that changes on the way is reported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/triangle_view.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/lattice.h>

namespace trisect {

/// What happens to a polygon whose corners do not lie in one plane exactly. Every file with
/// quadrilaterals in decimal coordinates has such faces.
enum class NonplanarPolicy : std::uint8_t {
    Triangulate,  ///< cut into triangles and counted: nothing moves
    Refuse,       ///< InvalidSolid naming the face
    Refit         ///< corners of faces that are nearly perpendicular to an axis move by at most
                  ///< `refit_move`
};

struct ImportOptions {
    NonplanarPolicy nonplanar = NonplanarPolicy::Triangulate;
    /// How far Refit may move a coordinate, in the user's units.
    double refit_move = 0;
    /// Coordinates are rounded to whole numbers of its unit. Default: the lattice of
    /// choose_lattice(), which keeps every double where they span at most 126 bits.
    std::optional<Lattice> lattice = std::nullopt;
    /// Throw InvalidSolid when the boundary is not closed; otherwise the defects are reported.
    bool require_closed = true;
    /// Threads that may take part; 0 means one for every processor. The result does not depend on
    /// it. Small meshes, and most of what other meshes than those of triangles need, are done by
    /// the calling thread alone.
    std::uint32_t threads = 0;
};

/// What import found and changed.
struct ImportReport {
    LatticeReport lattice;
    std::size_t welded_points = 0;  ///< points that repeat the value of an earlier one
    std::size_t nonplanar_faces = 0;
    std::size_t refitted_faces = 0;
    double max_refit_move = 0;  ///< user's units
    /// Faces whose corners lie on one line. They bound nothing and are left out; the boundary is
    /// closed without them exactly when it is with them.
    std::size_t degenerate_faces_dropped = 0;
    /// Edges whose traversals cancel only together with other edges of their line: a corner of one
    /// face lies inside an edge of another. Closed nevertheless. Of what is left without degenerate
    /// faces.
    std::size_t t_edges = 0;
    bool closed = true;       ///< the faces' boundaries cancel
    bool inside_out = false;  ///< closed, and the enclosed volume is negative
    ValidationReport defects;
};

struct ImportedMesh {
    LatticeMesh mesh;
    ImportReport report;
};

/// Places coordinates on the lattice, connects points of equal value, cuts polygons into triangles
/// and checks that the boundary is closed. Connectivity is by value on the lattice: triangle soups
/// are fine. Points of no triangle are left out; the others keep their order.
///
/// Without a lattice in the options coordinates are as they are (minus zero becomes plus zero), and
/// come out so, bit for bit. What does not fit into 126 bits is rounded, and rounded to whole
/// coordinates are meshes whose boundary is closed only then, and those with faces that Refit makes
/// planar. The report says so.
///
/// Nothing else is checked (see validate) and nothing is repaired: an inside-out mesh stays so.
/// Cost: O(n); 20 ns a triangle for meshes of triangles whose sides cancel by name, 100 ns for
/// others.
/// \throw UsageError for indices out of range, LimitError for coordinates that are not finite or
/// leave the lattice, InvalidSolid as the options say, UnsupportedError for a face that Refit
/// cannot make planar.
[[nodiscard]] ImportedMesh import_mesh(const PolygonMesh& mesh, const ImportOptions& options = {});
/// The same. Nothing is copied before it is rounded and connected where all sides cancel by name.
/// \throw as above, and LimitError for more than 2^32 - 1 corners
[[nodiscard]] ImportedMesh import_mesh(const TriangleView& mesh, const ImportOptions& options = {});

}  // namespace trisect
