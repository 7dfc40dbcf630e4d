// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of lattice points, exact, and enclosing hulls.
// Points off the lattice get enclosing hulls.
#pragma once

#include <span>

#include <trisect/bsp/hierarchies/convex/convex_polytope.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/point.h>

namespace trisect::hierarchies {

/// The hull of points of a lattice, exact: any number of them, in any position, repeated or not.
/// O(n log n) expected on points in no special order; O(n²) in the worst case.
/// Source: Barber, Dobkin, Huhdanpaa, The Quickhull algorithm for convex hulls (ACM TOMS 22(4),
/// 1996), with exact signs.
[[nodiscard]] ConvexPolytope convex_hull(std::span<const LatticePoint> points, Lattice lattice);

/// A hull of lattice points that contains all the points. Exact where they are lattice points; any
/// other point stands for the corners of the smallest cube of lattice units that certainly contains
/// it, so the hull reaches at most a few units farther; among lattice points with fractions, of the
/// smallest box of doubles. \throw LimitError when such a corner leaves the lattice's range.
[[nodiscard]] ConvexPolytope enclosing_hull(std::span<const Point> points, Lattice lattice);

}  // namespace trisect::hierarchies
