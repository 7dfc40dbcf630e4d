// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/edge_chains.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

void EdgeChains::arrange(std::span<BoundaryEdge> edges) {
    if (edges.size() <= few) {
        arrange_few(edges);
    } else if (!are_simple(edges)) {
        arrange_many(edges);
    }
}

void EdgeChains::arrange_few(std::span<BoundaryEdge> edges) {
    // Where nothing continues an edge (a loop is closed) the next one begins a loop.
    for (std::size_t i = 0; i + 2 < edges.size(); ++i) {
        std::size_t j = i + 1;
        while (j < edges.size() && edges[j].from != edges[i].to) ++j;
        if (j < edges.size()) std::swap(edges[i + 1], edges[j]);
    }
}

// False where several edges leave a vertex.
bool EdgeChains::list_leaving(std::span<const BoundaryEdge> edges) {
    ++region_;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::size_t from = as_index(edges[i].from);
        if (from >= seen_.size()) seen_.resize(std::max(2 * seen_.size(), from + 1), 0);
        if (std::exchange(seen_[from], region_) == region_) return false;
        leaving_.resize(seen_.size());
        leaving_[from] = static_cast<std::uint32_t>(i);
    }
    return true;
}

// Loops come in the order of their first edges. That one does not close shows where loops are made.
void EdgeChains::arrange_many(std::span<BoundaryEdge> edges) {
    if (!list_leaving(edges)) return;
    const auto is_left = [&](PointId p) {
        return as_index(p) < seen_.size() && seen_[as_index(p)] == region_;
    };
    is_placed_.assign(edges.size(), 0);
    arranged_.clear();
    arranged_.reserve(edges.size());
    for (std::size_t start = 0; start < edges.size(); ++start) {
        for (std::size_t i = start; is_placed_[i] == 0; i = leaving_[as_index(edges[i].to)]) {
            is_placed_[i] = 1;
            arranged_.push_back(edges[i]);
            if (!is_left(edges[i].to)) return;
        }
    }
    std::ranges::copy(arranged_, edges.begin());
}

bool EdgeChains::are_simple(std::span<const BoundaryEdge> edges) {
    ++region_;
    PointId start = -1;  // of the loop in the making
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::size_t from = as_index(edges[i].from);
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
