// SPDX-License-Identifier: Apache-2.0
//
// Facets that are beside a boundary, and those that are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Takes apart a solid with settled parts that is to be intersected with another solid: what may
/// meet the other one's boundary is all that the intersection needs to look at.
class BesideBoundary {
public:
    using Solid = OutlineStore::Solid;
    using Side = VertexSides::Side;

    /// The last two solids of the store; the other one comes first, and has no settled parts.
    BesideBoundary(CommonPart& common, const Solid& other, const Solid& solid);
    /// What is beside the boundary takes the solid's place; all else is in its settled parts, of
    /// which those facets that the other solid does not leave open come last. `threads` as for
    /// ParallelParts.
    [[nodiscard]] Solid take(std::uint32_t threads);
    /// By vertex of that, the side of the other solid, where cells say it.
    [[nodiscard]] std::span<const Side> known() const { return known_; }
    /// Drops those facets, once all is intersected. `result` is the last solid.
    void drop(const Solid& result) const;

private:
    void find_places(std::size_t first, std::size_t end);
    void find_sides(std::size_t number);
    void sort(std::size_t number);
    [[nodiscard]] Solid join_near();
    [[nodiscard]] Side side_at(const OutlineVertex& vertex) const;

    CommonPart& common_;
    Solid solid_;
    OutlinedSolid other_;  // good until something is added to the store
    BoundaryCells cells_;
    std::vector<Side> sides_;                              // by part of the cells
    SettledParts parts_;                                   // of the solid
    std::vector<PoolVector<BoundaryCells::Part>> places_;  // by part of the solid and facet
    // By part of the solid: how many facets are kept, and how many are not beside the boundary.
    std::vector<std::size_t> kept_;
    std::vector<std::size_t> far_;
    PoolVector<Side> known_;
};

}  // namespace trisect::detail
