// SPDX-License-Identifier: Apache-2.0
//
// Checks that a mesh or B-rep has whole coordinates.
#pragma once

#include <algorithm>

#include <trisect/brep/brep.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

[[noreturn]] inline void refuse_fractions() {
    throw UnsupportedError(
        "coordinates with fractions of the lattice's spacing are not supported by the tree");
}

/// Throws UnsupportedError where a point has a fraction.
inline void require_whole(const LatticeMesh& mesh) {
    if (!std::ranges::all_of(mesh.points, &LatticePoint::is_whole)) refuse_fractions();
}

/// Throws UnsupportedError where a point has a fraction, or a plane of a face has more digits than
/// whole coordinates give it.
inline void require_whole(const Brep& brep) {
    for (const Point& p : brep.points())
        if (p.is_lattice() && !p.lattice().is_whole()) refuse_fractions();
    for (const FaceId f : brep.faces())
        if (brep.plane(f).tier() > 1) refuse_fractions();
}

}  // namespace trisect::detail
