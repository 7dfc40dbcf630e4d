// SPDX-License-Identifier: Apache-2.0
//
// BoundaryFacet, BoundaryEdge: the units of assembly.
// They are made from the polygons of the cells.
#pragma once

#include <cstdint>

#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A facet of a source as it appears in the result; `flipped` facets face the other way. Facets are
/// ordered by source, number and orientation, so that output does not depend on the tree's shape.
struct BoundaryFacet {
    const Source* source = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    PlaneId support = -1;
    std::int32_t leaf = -1;         ///< where parts of it were found
    bool in_several_cells = false;  ///< its parts were not all conformed in one leaf
    std::uint32_t parts = 0;        ///< how many; the edges of one come in the order of its loop
    bool unchanged = false;         ///< see mark_unchanged_facets
    bool is_special = false;        ///< traced, and vertices may coincide or lie inside edges
    bool is_general = false;        ///< outlined or traced, and other facets do no more than cross
                                    ///< it; planes of its own edges come just before the support
};

/// An edge of a part of a facet, directed so that the part lies to its left seen from outside.
struct BoundaryEdge {
    PointId from = -1;
    PointId to = -1;
    std::int32_t facet = -1;  ///< index of the BoundaryFacet
    WorkEdge line;            ///< the edge's line is support ∩ line.plane; the part's side of it
};

using BoundaryEdges = PoolVector<BoundaryEdge>;

}  // namespace trisect::detail
