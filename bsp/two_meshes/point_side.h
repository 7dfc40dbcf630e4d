// SPDX-License-Identifier: Apache-2.0
//
// PointSide: the side of a shifted mesh that a point is on.
#pragma once

#include <optional>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/infinitesimal_shift.h>

namespace trisect::detail {

/// A mesh, embedded, and how it lies to points of the other one.
class PointSide {
public:
    /// `is_second`: points are of the second mesh, which is moved, else the mesh is that.
    /// `outer_below`: far out is below the mesh's facets.
    PointSide(const LatticeMesh& mesh, bool is_second, const InfinitesimalShift& shift,
              bool outer_below);

    /// Whether a point is below the mesh's facets. Nothing where no line from it avoids edges that
    /// are parallel to it, which chance makes all but impossible. O(n)
    [[nodiscard]] std::optional<bool> is_below(const LatticePoint& point) const;

private:
    [[nodiscard]] std::optional<int> passages(const LatticePoint& from,
                                              const LatticePoint& to) const;

    const LatticeMesh& mesh_;
    InfinitesimalShift shift_;
    Box box_;
    bool is_second_;
    bool outer_below_;
};

}  // namespace trisect::detail
