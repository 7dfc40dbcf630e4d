// SPDX-License-Identifier: Apache-2.0
//
// SettledPart: a part of the boundary of an outlined solid, by itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// It has vertices, edges and lines of its own, so it can go from one OutlineStore to another as it
/// is. Vertices that the solid has elsewhere, too, are shared ones.
struct SettledPart {
    PoolVector<OutlinedSolid::Facet> facets;
    PoolVector<OutlineBox> boxes;
    PoolVector<OutlinedSolid::Edge> edges;
    PoolVector<OutlineVertex> vertices;
    PoolVector<FacetCrossing> lines;      ///< of those edges
    OutlineBox box = OutlineBox::none();  ///< of all, also of those that are not here any more

    /// Where sides of a boundary are known: so many facets come first that are not beside it.
    std::size_t far = 0;

    /// A whole facet without an outline here.
    struct Whole {
        std::uint32_t number = 0;
        std::uint32_t slot = 0;
    };
    /// Facets that nothing will change any more, as assembly takes them, besides those above.
    PoolVector<Whole> kept_whole;
    PoolVector<OutlinedFacets::Facet> kept;
    PoolVector<OutlinedFacets::Edge> kept_edges;  ///< with vertices of the part

    /// Good until the part changes.
    [[nodiscard]] OutlinedSolid view() const {
        OutlinedSolid out;
        out.facets = facets;
        out.boxes = boxes;
        out.edges = edges;
        out.vertices = vertices;
        out.lines = lines;
        out.box = box;
        out.open_far_out = true;
        return out;
    }
};

using SettledParts = std::vector<std::unique_ptr<SettledPart>>;

}  // namespace trisect::detail
