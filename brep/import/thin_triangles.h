// SPDX-License-Identifier: Apache-2.0
//
// Removal of triangles that are thinner than the rounding of their corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

struct TrianglesWithoutThin {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> origin;  ///< by triangle: the one before whose face it is part of
    /// By point: the one that it became, which is a fixed point.
    std::vector<std::uint32_t> point;
    /// What the triangles that were flipped bounded on one side alone, before or after, is not
    /// farther than this from the boundary of the others, whose points have moved.
    double reach = 0;
};

/// A closed triangulation without triangles that are thinner than `width`, as far as that goes.
///
/// Rounding turns such triangles over, and then they meet their neighbours. Points at the ends of
/// an edge that is not longer than `width` become one, the first of them. A triangle whose height
/// over its longest edge is not more than that gives that edge up: it and its neighbour across it
/// are divided by the other diagonal. No point moves otherwise, and what was closed stays closed:
/// each step adds the boundary of a tetrahedron, or maps points to points. Whether the result meets
/// itself is not looked at. Decided in doubles; the same input gives the same result. O(n log n).
[[nodiscard]] TrianglesWithoutThin without_thin_triangles(
    std::span<const Point3d> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    double width);

/// A mesh whose thin triangles are given up.
struct ThickMesh {
    PolygonMesh mesh;
    std::vector<std::uint32_t> origin;  ///< by face: the one before whose face it is part of
    double move = 0;                    ///< of a coordinate, at most
    double reach = 0;                   ///< as above
};

/// The same of a mesh, with a width of so many times the largest coordinate. Points are kept, used
/// or not. \pre all faces are triangles
[[nodiscard]] ThickMesh thick_mesh(const PolygonMesh& mesh, double relative_width);

}  // namespace trisect::detail
