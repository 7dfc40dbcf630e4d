// SPDX-License-Identifier: Apache-2.0
//
// EdgeChains: boundary edges of a region in the order of its loops.
// Nearly all regions have one loop of a handful of edges that passes no vertex twice. Once such
// edges are in order nothing needs to sort or to search them again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Holds scratch memory.
class EdgeChains {
public:
    /// Reorders the edges of one region so that each is followed by the one that continues it. A
    /// region of more than `few` edges stays as it is where it passes a vertex twice. O(n).
    void arrange(std::span<BoundaryEdge> edges);
    static constexpr std::size_t few = 32;

    /// Whether the edges come loop by loop, each followed by the one that continues it, and no
    /// vertex is passed twice. O(n).
    [[nodiscard]] bool are_simple(std::span<const BoundaryEdge> edges);

private:
    static void arrange_few(std::span<BoundaryEdge> edges);
    void arrange_many(std::span<BoundaryEdge> edges);
    [[nodiscard]] bool list_leaving(std::span<const BoundaryEdge> edges);

    PoolVector<std::uint32_t> seen_;  // by point: the last region that passed it
    std::uint32_t region_ = 0;
    // Of a region of many edges:
    PoolVector<std::uint32_t> leaving_;  // by point: the edge that leaves it
    PoolVector<std::uint8_t> is_placed_;
    BoundaryEdges arranged_;
};

/// Calls visit(i, j) for every edge i of simple chains, with j the edge that continues it.
template <class Visit>
void for_each_turn(std::span<const BoundaryEdge> edges, Visit&& visit) {
    for (std::size_t start = 0, i = 0; i < edges.size(); ++i) {
        if (edges[i].to == edges[start].from) {
            visit(i, start);
            start = i + 1;
        } else {
            visit(i, i + 1);
        }
    }
}

}  // namespace trisect::detail
