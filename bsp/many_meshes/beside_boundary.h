// SPDX-License-Identifier: Apache-2.0
//
// Facets that are beside a boundary, and those that are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// What a boundary and operands that are neighbours leave open: what of these may meet the boundary
/// is all that an intersection needs to look at.
class BesideBoundary {
public:
    using Solid = OutlineStore::Solid;
    using Side = VertexSides::Side;

    /// Of the last solid of the store, which has no settled parts, and of operands. `threads` as
    /// for ParallelParts.
    BesideBoundary(CommonPart& common, const ManyMeshes& meshes, const Solid& boundary,
                   std::span<const std::uint32_t> slots, std::uint32_t threads);
    [[nodiscard]] const BoundarySides& sides() const { return sides_; }
    /// Of what the operands leave open, behind the boundary in the store, all of which has settled
    /// with regard to sides(): what is beside the boundary, with all else in settled parts.
    [[nodiscard]] Solid take(const Solid& solid);
    /// By vertex of that, the side of the boundary's solid, where cells say it.
    [[nodiscard]] std::span<const Side> known() const { return known_; }

private:
    void find_sides(const OutlinedSolid& boundary, std::span<const std::uint32_t> slots);
    [[nodiscard]] Solid join_near(SettledParts& parts) const;
    [[nodiscard]] Side side_at(const OutlineVertex& vertex) const;

    CommonPart& common_;
    const ManyMeshes& meshes_;
    std::uint32_t threads_;
    BoundarySides sides_;
    PoolVector<Side> known_;
};

}  // namespace trisect::detail
