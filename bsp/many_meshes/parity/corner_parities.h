// SPDX-License-Identifier: Apache-2.0
//
// CornerParities: parities of the meshes around corners of others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/parity/pierced_edges.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A parity is 1 where the number of other meshes is odd below whose facets a point is. It changes
/// along an edge where that pierces a facet, so one point of what hangs together by edges says it
/// for all.
class CornerParities {
public:
    /// `solids`: views of the operands, open below their facets.
    CornerParities(std::span<const OutlinedSolid> solids, const OutlinedSolid& all,
                   const PiercedEdges& pierced, const ShiftedPoints& exact)
        : solids_(solids), all_(all), pierced_(pierced), exact_(exact) {}

    /// `is_crossed`: by facet. False where ways to a corner disagree.
    [[nodiscard]] bool find(std::span<const std::uint8_t> is_crossed);

    [[nodiscard]] bool of_corner(std::uint32_t vertex) const { return corners_[vertex] != 0; }
    /// Of a point where an edge pierces a facet: among the meshes of neither.
    [[nodiscard]] bool of_point(std::uint32_t vertex) const {
        return points_[vertex - pierced_.first_vertex()] != 0;
    }

private:
    struct Root {
        std::uint32_t vertex = 0;
        bool is_other = false;  ///< the corner's parity is not that of the root
    };
    [[nodiscard]] Root root(std::uint32_t vertex);
    [[nodiscard]] bool join(std::uint32_t a, std::uint32_t b, bool differ);
    [[nodiscard]] bool join_edges(std::span<const std::uint8_t> is_crossed);
    void find_roots();
    [[nodiscard]] bool parity_at(std::uint32_t vertex, std::size_t slot) const;
    [[nodiscard]] std::size_t boxes_around(std::uint32_t vertex, std::size_t slot) const;
    void find_points();

    std::span<const OutlinedSolid> solids_;
    const OutlinedSolid& all_;
    const PiercedEdges& pierced_;
    const ShiftedPoints& exact_;
    PoolVector<Root> parents_;
    PoolVector<std::uint8_t> corners_;
    PoolVector<std::uint8_t> points_;
};

}  // namespace trisect::detail
