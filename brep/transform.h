// SPDX-License-Identifier: Apache-2.0
//
// Transforms of meshes: exact lattice maps, and affine maps with reported rounding.
//
// Maps that reverse orientation turn every face over, so that normals stay outward.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/lattice.h>

namespace trisect {

/// p -> M p + t, the 3×4 matrix (M | t) row by row, as in pose and matrix files.
struct AffineMap {
    std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    [[nodiscard]] static AffineMap translation(const Point3d& by);
    [[nodiscard]] static AffineMap scaling(const Point3d& factors);
    /// Counter-clockwise seen from the tip of the axis, through the origin. Entries are rounded,
    /// except for multiples of 90 degrees about a coordinate axis: those are exact.
    /// \throw UsageError for a zero axis or numbers that are not finite.
    [[nodiscard]] static AffineMap rotation(const Point3d& axis, double degrees);
    /// The reflection in the coordinate plane perpendicular to the axis 0, 1 or 2.
    [[nodiscard]] static AffineMap mirror(int axis);

    /// Sign of det M, exact.
    [[nodiscard]] int orientation() const;
    /// Each coordinate within 2^-52 of its value and 2^-100 of its largest term: exact whenever the
    /// result is a double and the terms do not cancel beyond that.
    [[nodiscard]] Point3d apply(const Point3d& p) const;
    friend bool operator==(const AffineMap&, const AffineMap&) = default;
};

/// First `first`, then `second`; entries are rounded.
[[nodiscard]] AffineMap compose(const AffineMap& second, const AffineMap& first);

/// O(n). \throw UsageError for a singular map or one with entries that are not finite.
[[nodiscard]] PolygonMesh transformed(PolygonMesh mesh, const AffineMap& map);

/// Exact: the vector is in lattice units. \throw LimitError when a point leaves the lattice, or,
/// with bits behind the point, when a coordinate would not be a double.
[[nodiscard]] LatticeMesh translated(const LatticeMesh& mesh, const LatticePoint& by);
/// Exact: counter-clockwise by quarter_turns · 90° about the coordinate axis 0, 1 or 2.
[[nodiscard]] LatticeMesh rotated_by_quarter_turns(const LatticeMesh& mesh, int axis,
                                                   int quarter_turns);
/// Exact: in the coordinate plane perpendicular to the axis 0, 1 or 2.
[[nodiscard]] LatticeMesh mirrored(const LatticeMesh& mesh, int axis);
/// Exact: by 2^power. The lattice's unit takes up multiples of 8 of it, the coordinates the rest.
/// \throw LimitError when that rest does not fit.
[[nodiscard]] LatticeMesh scaled_by_power_of_two(const LatticeMesh& mesh, int power);

/// Any affine map; corners are rounded to the mesh's lattice and the report says how far they moved
/// and how many triangles were turned over or became flat. Coordinates are whole if all of the mesh
/// are, else the nearest doubles, with up to fraction_limit bits behind the point. Flat triangles
/// are left out, points that became equal are one: the boundary stays closed. The result may
/// intersect itself.
/// \throw UsageError as above, LimitError when a point leaves the lattice.
[[nodiscard]] LatticeMesh transformed(const LatticeMesh& mesh, const AffineMap& map,
                                      LatticeReport& report);

}  // namespace trisect
