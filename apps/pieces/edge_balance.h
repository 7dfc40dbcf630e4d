// SPDX-License-Identifier: Apache-2.0
//
// Directed edges of triangles that lack an opposite one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace trisect::app {

using DirectedEdge = std::array<std::uint32_t, 2>;

/// For each edge that runs more often one way than the other, the edges that are missing: those of
/// the rarer direction, as often as needed. Sorted by their ends.
[[nodiscard]] inline std::vector<DirectedEdge> missing_edges(std::vector<DirectedEdge> edges) {
    const auto ends = [](const DirectedEdge& e) { return std::minmax(e[0], e[1]); };
    std::ranges::sort(edges, [&](const DirectedEdge& a, const DirectedEdge& b) {
        return std::pair(ends(a), a) < std::pair(ends(b), b);
    });
    std::vector<DirectedEdge> out;
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::find_if(
            first, edges.end(), [&](const DirectedEdge& e) { return ends(e) != ends(*first); });
        const auto forth =
            std::count_if(first, last, [](const DirectedEdge& e) { return e[0] < e[1]; });
        const auto back = (last - first) - forth;
        const auto [low, high] = ends(*first);
        for (auto n = back; n < forth; ++n) out.push_back({high, low});
        for (auto n = forth; n < back; ++n) out.push_back({low, high});
        first = last;
    }
    return out;
}

}  // namespace trisect::app
