// SPDX-License-Identifier: Apache-2.0
//
// BSplineSurface: a tensor-product B-spline surface, polynomial or rational (NURBS).
// It is evaluated as the Bézier patches of its knot spans.
#pragma once

#include <cstddef>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>

namespace trisect {

/// The surface over [u_p, u_m] × [v_q, v_n], where u_p and u_m are the knots number degree_u and
/// (count_u) of the knot vector. Knot vectors may be clamped or not; a closed direction repeats its
/// first control points as its last ones.
struct BSplineSurface {
    std::size_t degree_u = 3;
    std::size_t degree_v = 3;
    std::vector<double> knots_u;  ///< count_u + degree_u + 1 of them, ascending
    std::vector<double> knots_v;
    /// Row by row: point i·count_v + j; count_u and count_v follow from the knots.
    std::vector<Point3d> points;
    std::vector<double> weights;  ///< none: 1 each
};

struct BSplinePatches {
    /// Row by row, a patch for each pair of knot spans that are not empty. Neighbours have bit for
    /// bit the same control points along their common side.
    std::vector<BezierPatch> patches;
    std::size_t rows = 0;
    std::size_t columns = 0;
    /// Every point of the surface is within this distance of the patches' point with the same
    /// parameters: control points are computed in rationals and rounded once.
    double largest_move = 0;
};

/// Insertion of every inner knot up to its full multiplicity, by the polar form (Ramshaw 1989).
/// \throw UsageError for counts that do not fit, knots that descend, are not finite or leave no
/// span, and what BezierPatch refuses. Exact rationals: some microseconds a control point.
[[nodiscard]] BSplinePatches to_bezier(const BSplineSurface& surface);

}  // namespace trisect
