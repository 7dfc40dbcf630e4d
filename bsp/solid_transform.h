// SPDX-License-Identifier: Apache-2.0
//
// Transforms and connected components of solids.
// Faces keep the names of the operands' faces.
#pragma once

#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// The solid under an affine map. The inside stays the inside under a mirror.
///
/// Quarter turns about coordinate axes, mirrors and translations by multiples of the lattice's unit
/// are exact and keep the tree; the lattice becomes finer where that makes a translation exact.
/// Another translation is rounded as a whole, so that the solid stays congruent: every vertex moves
/// by less than half a unit. Under any other map, or where coordinates have fractions, vertices are
/// rounded to the user's doubles one by one, once, from exact positions; planar faces of more than
/// three corners fall apart into triangles. Where that makes the boundary meet itself, corners that
/// an edge of up to 4 (or else 16) units in the last place of the largest coordinate connects
/// become one, and triangles as thin are joined with neighbours, if it meets itself no more then;
/// otherwise it is resolved by what comes next.
///
/// `report` is overwritten. O(n). To ask how moving solids lie to each other use poses as they are
/// (bsp/interference): nothing is rounded there.
/// \throw UnsupportedError for an unbounded boundary under a map of the last kind; LimitError when
/// the solid leaves the lattice; InvalidSolid when nothing is left of it.
[[nodiscard]] Solid transformed(const Solid& solid, const Pose& pose,
                                LatticeReport* report = nullptr);
/// By a matrix of doubles, as they are. \throw UsageError for a singular map, and as above
[[nodiscard]] Solid transformed(const Solid& solid, const AffineMap& map,
                                LatticeReport* report = nullptr);

/// The boundary of a bounded solid under a map: vertices are rounded to doubles one by one, once,
/// from exact positions, which may make it meet itself. What transformed() makes a solid of, for
/// all maps that round vertices. \throw UsageError for a singular map, LimitError as above
[[nodiscard]] PolygonMesh transformed_mesh(const ExactMesh& mesh, const AffineMap& map);

/// The connected parts, each with its cavities; parts that touch in points or edges are apart, and
/// so are parts within the cavity of another one. Ordered by the smallest face of to_brep(). Costs
/// to_brep(). \throw UnsupportedError for an unbounded set
[[nodiscard]] std::vector<Solid> components(const Solid& solid);

}  // namespace trisect
