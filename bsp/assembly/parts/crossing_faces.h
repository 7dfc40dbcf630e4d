// SPDX-License-Identifier: Apache-2.0
//
// CrossingFaces: edges in which faces cross each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// The ends of an edge as one number, the same for both directions.
[[nodiscard]] inline std::uint64_t ends_of(const BoundaryEdge& e) {
    const PointId lo = e.from < e.to ? e.from : e.to;
    const PointId hi = e.from < e.to ? e.to : e.from;
    return (static_cast<std::uint64_t>(lo) << 32) | static_cast<std::uint32_t>(hi);
}

/// A directed edge, by its facet and by which of its two ends it begins at.
struct FacetEdge {
    const Source* source = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    bool up = false;
};

/// Of edges with the same two ends: whether faces of two planes or more go straight across each
/// other there. A face goes straight across where facets in one oriented plane have the edge in
/// both directions. Sectors of inside and outside alternate six times or more around such an edge.
/// O(n²).
[[nodiscard]] bool cross_straight(std::span<const FacetEdge> edges);

/// Adds to `edges` those of the cancelled ones, which come in opposite pairs, on which faces go
/// straight across each other. \pre edges on one segment have the same ends, those of `edges` are
/// sorted by facet; so they come out, in the order of their loops where they are few.
void put_back_crossings(const BoundaryParts& parts, std::span<const BoundaryEdge> cancelled,
                        BoundaryEdges& edges);

/// Of facets that pass through whole: an edge with the ends of one of the boundary's edges.
struct WholeFacetEdge {
    std::uint64_t ends = 0;
    FacetEdge edge;
};

/// The edges of facets that pass through whole on edges of cut facets of the same mesh. There are
/// some only where more than two facets of a mesh meet in an edge. O(whole facets of those meshes).
/// `threads` as in ParallelParts.
[[nodiscard]] PoolVector<WholeFacetEdge> whole_facets_on(const BoundaryParts& parts,
                                                         std::span<const BoundaryEdge> edges,
                                                         std::uint32_t threads = 1);

/// Of outlines of moved meshes: makes BoundaryParts::crossings. False where an outline crosses such
/// an edge, or has a part of it. \pre edges on one segment have the same ends
[[nodiscard]] bool find_lacking_crossings(BoundaryParts& parts);

}  // namespace trisect::detail
