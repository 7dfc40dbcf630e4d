// SPDX-License-Identifier: Apache-2.0
//
// Parts of the edges of a boundary.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Fewer edges are not worth a part.
constexpr std::size_t least_edges = 8192;

/// How many parts for_each_part makes of so many edges.
inline std::size_t count_of_edge_parts(std::size_t edges, std::uint32_t threads) {
    return ParallelParts(edges, threads, least_edges).count();
}

/// Calls work(part, begin, end) for parts of the edges; those of a facet stay together. The work
/// may reorder the edges of its part. `threads` as in ParallelParts.
template <class Work>
void for_each_part(std::span<const BoundaryEdge> edges, std::uint32_t threads, const Work& work) {
    const ParallelParts parts(edges.size(), threads, least_edges);
    PoolVector<std::size_t> bounds{0};
    for (std::size_t part = 1; part < parts.count(); ++part) {
        std::size_t i = std::max(bounds.back(), edges.size() * part / parts.count());
        while (i != 0 && i < edges.size() && edges[i].facet == edges[i - 1].facet) ++i;
        bounds.push_back(i);
    }
    bounds.push_back(edges.size());
    parts.for_each([&](std::size_t part, std::size_t, std::size_t) {
        work(part, bounds[part], bounds[part + 1]);
    });
}

}  // namespace trisect::detail
