// SPDX-License-Identifier: Apache-2.0
//
// First half of assembly: from the polygons of the cells to directed edges between exact vertices.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/workbench.h>

namespace trisect::detail {

/// A facet of a source as it appears in the result; `flipped` facets face the other way. `order` is
/// the rank by (source, facet, flipped), so that output does not depend on the tree's shape.
struct BoundaryFacet {
    const Source* source = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    PlaneId support = -1;
};

/// An edge of a part of a facet, directed so that the part lies to its left seen from outside.
struct BoundaryEdge {
    PointId from = -1;
    PointId to = -1;
    std::int32_t facet = -1;  ///< index of the BoundaryFacet
    WorkEdge line;            ///< the edge's line is support ∩ line.plane; the part's side of it
};

/// The boundary in pieces, conforming within each facet's cells but not yet joined.
struct BoundaryParts {
    Workbench bench;
    std::vector<BoundaryFacet> facets;  ///< sorted by source, facet, flipped
    std::vector<BoundaryEdge> edges;    ///< of facets that are cut, touched or span several cells
    std::vector<std::int32_t> whole;    ///< facets that no one touched, indices into `facets`
};

/// With `all`, untouched facets too are given as edges.
void gather_parts(const SolidState& solid, bool all, BoundaryParts& parts);

/// Splits every edge at the vertices that lie inside it. `points` are candidate vertices.
/// Edges and candidates must belong to one leaf or one facet: the cost is near linear in the
/// candidates whose x-range meets an edge's.
void insert_points_on_edges(const Workbench& bench, const std::vector<BoundaryFacet>& facets,
                            std::vector<PointId> points, std::vector<BoundaryEdge>& edges);

/// Order of two points along an axis: filtered, then exact.
[[nodiscard]] int compare_along(const Workbench& bench, PointId a, PointId b, int axis);

}  // namespace trisect::detail
