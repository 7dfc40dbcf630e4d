// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/edge_chains.h>

#include <algorithm>
#include <utility>

namespace trisect::detail {

void EdgeChains::arrange(std::span<BoundaryEdge> edges) {
    if (edges.size() > few) return;
    // Where nothing continues an edge (a loop is closed) the next one begins a loop.
    for (std::size_t i = 0; i + 2 < edges.size(); ++i) {
        std::size_t j = i + 1;
        while (j < edges.size() && edges[j].from != edges[i].to) ++j;
        if (j < edges.size()) std::swap(edges[i + 1], edges[j]);
    }
}

bool EdgeChains::are_simple(std::span<const BoundaryEdge> edges) {
    ++region_;
    PointId start = -1;  // of the loop in the making
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto from = static_cast<std::size_t>(edges[i].from);
        if (from >= seen_.size()) seen_.resize(std::max(2 * seen_.size(), from + 1), 0);
        if (std::exchange(seen_[from], region_) == region_) return false;
        if (start < 0) start = edges[i].from;
        if (edges[i].to == start) {
            start = -1;
        } else if (i + 1 == edges.size() || edges[i + 1].from != edges[i].to) {
            return false;
        }
    }
    return start < 0;
}

}  // namespace trisect::detail
