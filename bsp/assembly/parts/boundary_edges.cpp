// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/boundary_edges.h>

#include <algorithm>
#include <numeric>

#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

void sort_by_facet(const BoundaryParts& parts, BoundaryEdges& edges) {
    const auto by_facet = [](const auto& a, const auto& b) { return a.facet < b.facet; };
    if (std::is_sorted(edges.begin(), edges.end(), by_facet)) return;
    PoolVector<std::size_t> fill(parts.facets.size() + 1, 0);
    for (const BoundaryEdge& e : edges) ++fill[as_index(e.facet) + 1];
    std::partial_sum(fill.begin(), fill.end(), fill.begin());
    BoundaryEdges sorted(edges.size());
    for (const BoundaryEdge& e : edges) sorted[fill[as_index(e.facet)]++] = e;
    edges.swap(sorted);
}

void arrange_loops(std::span<BoundaryEdge> edges) {
    EdgeChains chains;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        while (j < edges.size() && edges[j].facet == edges[i].facet) ++j;
        chains.arrange(edges.subspan(i, j - i));
        i = j;
    }
}

}  // namespace trisect::detail
