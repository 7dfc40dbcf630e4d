// SPDX-License-Identifier: Apache-2.0
//
// A point is found once for each facet that has the edge: those of an edge all cross what it
// pierces.

#include <trisect/bsp/many_meshes/parity/pierced_edges.h>

#include <algorithm>

#include <trisect/bsp/many_meshes/stops_in_order.h>

namespace trisect::detail {

bool PiercedEdges::find(std::span<const FacetCrossing> pairs, PoolVector<OutlineVertex>& vertices) {
    first_vertex_ = static_cast<std::uint32_t>(vertices.size());
    points_.reserve(pairs.size());
    edges_.reserve(pairs.size());
    ends_.reserve(pairs.size());
    for (const FacetCrossing& c : pairs)
        ends_.push_back({vertex_at(c, 0, vertices), vertex_at(c, 1, vertices)});
    if (std::ranges::any_of(times_, [](std::uint8_t n) { return n % 2 != 0; })) return false;
    first_.assign(pierced_.size() + 1, 0);
    for (const Found& f : found_) ++first_[f.edge + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    PoolVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    stops_.resize(found_.size());
    for (const Found& f : found_) stops_[next[f.edge]++] = f.stop;
    found_.clear();
    for (std::size_t i = 0; i < pierced_.size(); ++i) {
        const std::span<Stop> stops =
            std::span(stops_).subspan(first_[i], first_[i + 1] - first_[i]);
        if (!sort(stops, pierced_[i], vertices)) return false;
    }
    return true;
}

// An edge has its facet on its left, and what lies below the cutter is on the left of a crossing
// with a second facet, on the right of one with a first one. So along an edge of the first facet
// one comes above the second one where the crossing begins.
std::uint32_t PiercedEdges::vertex_at(const FacetCrossing& crossing, std::size_t k,
                                      PoolVector<OutlineVertex>& vertices) {
    const FacetCrossing::End& end = crossing.ends[k];
    const std::size_t owner = end.of_second ? 1 : 0;
    const std::uint32_t facet = crossing.facets[owner];
    const std::uint32_t cutter = crossing.facets[1 - owner];
    const std::uint32_t edge = 3 * facet + static_cast<std::uint32_t>(end.edge);
    const OutlinedSolid::Edge& e = all_.edges[edge];
    Key128 name = name_of(e);
    name.b = std::uint64_t{cutter} + 1;
    const auto [number, is_new] =
        points_.insert(name, static_cast<std::int32_t>(vertices.size() - first_vertex_));
    const std::uint32_t vertex = first_vertex_ + static_cast<std::uint32_t>(number);
    if (!is_new) {
        ++times_[static_cast<std::size_t>(number)];
        return vertex;
    }
    times_.push_back(1);
    OutlineVertex& v = vertices.emplace_back();
    v.at = end.at;
    v.kind = OutlineVertex::Kind::Pierce;
    v.which = end.edge;
    v.facets = {facet, cutter, 0};
    const auto [at, is_first] =
        edges_.insert(name_of(e), static_cast<std::int32_t>(pierced_.size()));
    if (is_first) pierced_.push_back(edge);
    const bool rises = (owner == 0) == (k == 0);
    found_.push_back(
        {{vertex, cutter, rises == (e.from < e.to), 0}, static_cast<std::uint32_t>(at)});
    return vertex;
}

bool PiercedEdges::sort(std::span<Stop> stops, std::uint32_t edge,
                        std::span<const OutlineVertex> vertices) const {
    const OutlinedSolid::Edge& e = all_.edges[edge];
    const bool is_along = e.from < e.to;
    const auto [first, last] = std::minmax(e.from, e.to);
    return sort_along(
        stops, vertices[first].at, vertices[last].at, vertices, [&](const Stop& s, const Stop& t) {
            return (is_along ? 1 : -1) * exact_.order_on_edge(edge / 3,
                                                              static_cast<std::int8_t>(edge % 3),
                                                              s.cutter, t.cutter);
        });
}

}  // namespace trisect::detail
