// SPDX-License-Identifier: Apache-2.0
//
// FacetCutter: triangles of the facets of a result that do not pass through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/face/rounded_polygon.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/face_corners.h>
#include <trisect/bsp/assembly/parts/face_loops.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Vertices that are no corners of a source, rounded.
struct MadeVertices {
    std::span<const std::uint32_t> number_of;  ///< by PointId
    std::span<const Point3d> coordinates;
    double unit = 1;  ///< of the lattice
};

/// Triangles of consecutive facets.
struct CutFacets {
    struct Facet {
        std::size_t source = 0;  ///< its number
        std::uint32_t facet = 0;
        bool flipped = false;
        std::size_t begin = 0;  ///< of its triangles among the corners
    };
    PoolVector<Facet> facets;
    PoolVector<PointId> corners;  ///< three a triangle
};

/// Cuts facets into triangles; keeps its memory. Several may work on one boundary at once when its
/// workbench is shared (Workbench::share).
class FacetCutter {
public:
    FacetCutter(const BoundaryParts& parts, const MadeVertices& made)
        : parts_(parts),
          bench_(parts.bench),
          made_(made),
          loops_(parts.bench),
          corners_(parts.bench) {}

    /// Appends the triangles of one facet, of which these are all edges. They depend on the exact
    /// points alone, not on the order of the edges.
    void cut(std::span<const BoundaryEdge> edges, CutFacets& out);

private:
    [[nodiscard]] bool is_all_of(const BoundaryFacet& f, std::span<const PointId> loop) const;
    void add_all_of(const BoundaryFacet& f, std::span<const PointId> loop,
                    PoolVector<PointId>& out) const;
    void cut_loop(std::size_t l, PoolVector<PointId>& out);
    void cut_small(std::size_t l, PoolVector<PointId>& out);
    [[nodiscard]] bool are_in_row(std::size_t l, const std::array<std::uint32_t, 3>& corners) const;
    void add_rounded(PointId p, PlaneProjection::Axes axes);
    [[nodiscard]] Approximation nearest(PointId p) const;
    [[nodiscard]] [[gnu::noinline]] int doubtful_turn(std::size_t l,
                                                      const std::array<std::uint32_t, 3>& corners);
    [[nodiscard]] int exact_turn(std::span<const PointId> loop,
                                 const std::array<std::uint32_t, 3>& corners,
                                 PlaneProjection::Axes axes);
    void cut_large(std::size_t first, std::size_t end, PoolVector<PointId>& out);

    const BoundaryParts& parts_;
    const Workbench& bench_;
    MadeVertices made_;
    FaceLoops loops_;
    RoundedPolygon rounded_;
    std::vector<HomogeneousPoint> exact_;  // of corners of a loop where it was needed
    std::vector<int> exact_of_;            // by corner of the loop
    PoolVector<std::uint32_t> local_;      // by PointId, while one face is triangulated
    FaceCorners corners_;
    std::vector<IndexLoop> outline_;
};

}  // namespace trisect::detail
