// SPDX-License-Identifier: Apache-2.0
//
// PreparedMesh: a PolygonMesh on a lattice, connected and triangulated.
// Corners are connected by value. Import and validation both start from it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// Loop f is face f of the input with corners renamed; equal neighbours in a loop are kept (they
/// have no side between them).
struct PreparedMesh {
    LatticeReport report;
    std::vector<LatticePoint> points;         ///< distinct
    std::vector<std::uint32_t> source_point;  ///< first index in the input of each
    std::vector<std::uint32_t> loop_begin{0};
    std::vector<std::uint32_t> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< not degenerate
    std::vector<std::uint32_t> face_of_triangle;
    std::vector<std::uint32_t> nonplanar_faces;  ///< ascending, as are the next two
    std::vector<std::uint32_t> degenerate_faces;
    std::vector<std::uint32_t> nonsimple_faces;
    std::size_t welded_points = 0;  ///< points of the input that repeat an earlier one's value

    [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t f) const {
        return {corners.data() + loop_begin[f], corners.data() + loop_begin[f + 1]};
    }
    [[nodiscard]] std::size_t face_count() const { return loop_begin.size() - 1; }
};

/// Checks the invariants of PolygonMesh (indices in range).
/// \throw UsageError naming the face.
void check_indices(const PolygonMesh& mesh);

/// Welds and renames: everything but the triangles. `lattice_points` are the mesh's points.
[[nodiscard]] PreparedMesh weld_mesh(const PolygonMesh& mesh,
                                     std::span<const LatticePoint> lattice_points);
/// Fills in triangles and the three lists of faces.
/// \throw LimitError for a face that is too large.
void triangulate_faces(PreparedMesh& mesh);

/// Edges of the loops whose traversals do not cancel by name, in lexicographic order. O(n).
[[nodiscard]] std::vector<NetEdge> find_net_edges(std::size_t point_count,
                                                  std::span<const std::uint32_t> loop_begin,
                                                  std::span<const std::uint32_t> corners);
/// How many there are of triangles alone. Where a degenerate face was dropped, through whose
/// corners its neighbours matched, a corner of one of them lies inside an edge of another.
[[nodiscard]] std::size_t count_net_edges(std::size_t point_count,
                                          std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace trisect::detail
