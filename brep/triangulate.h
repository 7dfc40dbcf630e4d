// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of planar faces with holes whose corners are exact points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/planar_loops.h>

namespace trisect {

using IndexTriangle = std::array<std::uint32_t, 3>;

/// Triangles that fill the face exactly, counter-clockwise seen from above the plane.
///
/// `loops` holds indices into `points`: the outer loop counter-clockwise, holes clockwise (their
/// order does not matter). Every corner is used, also one in the middle of a straight run, no
/// triangle has area zero and no corner lies inside a triangle or on its sides: neighbouring faces
/// match. Loops may touch themselves and each other in vertices (equal points under one or
/// several indices), and run along a segment in both directions: there the face is slit. A hole may
/// be a slit of two corners. The result depends on the exact points and the order of the loops
/// only.
///
/// A convex loop is halved again and again, O(n), so that no corner has many triangles; one with
/// few corners is cut by ears; all others by a sweep, O(n log n) whatever their shape and however
/// many holes they have. Triangles may be slender. \pre the points lie on the plane and the loops
/// bound a region. \throw Error Internal when they do not and no triangulation was found.
[[nodiscard]] std::vector<IndexTriangle> triangulate(const Plane& plane,
                                                     std::span<const Point> points,
                                                     std::span<const IndexLoop> loops);

/// The same for points that were projected already.
[[nodiscard]] std::vector<IndexTriangle> triangulate(const PlaneProjection& projection,
                                                     std::span<const IndexLoop> loops);

/// The triangles of a face; entries are indices of vertices of the Brep.
[[nodiscard]] std::vector<IndexTriangle> triangulate(const Brep& brep, FaceId face);

}  // namespace trisect
