// SPDX-License-Identifier: Apache-2.0
//
// A region is a 2-chain, its boundary a 1-chain: the boundary of a union of parts with disjoint
// interiors is the sum of their directed edges, where opposite ones cancel. So joining needs no
// geometry but the order of points on a line.
//
// Most regions have a handful of edges: everything works on runs of one flat array.

#include <trisect/bsp/assembly/joining/facet_joiner.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Cancels opposite pairs of few edges, in place; keeps the order of what is left.
std::size_t cancel_few(std::span<BoundaryEdge> edges, BoundaryEdges* cancelled) {
    std::array<std::uint64_t, EdgeChains::few> way{};
    const auto directed = [](PointId from, PointId to) {
        return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to);
    };
    constexpr std::uint64_t gone = ~std::uint64_t{0};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        way[i] = directed(edges[i].from, edges[i].to);
        const std::uint64_t back = directed(edges[i].to, edges[i].from);
        std::size_t j = 0;
        while (j < i && way[j] != back) ++j;
        if (j == i) continue;
        way[j] = way[i] = gone;
        if (cancelled != nullptr) cancelled->insert(cancelled->end(), {edges[j], edges[i]});
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (way[i] != gone) edges[left++] = edges[i];
    return left;
}

// The same for any number; what is left is ordered by (min, max, from).
std::size_t cancel_many(std::span<BoundaryEdge> edges, BoundaryEdges* cancelled) {
    std::sort(edges.begin(), edges.end(), [&](const BoundaryEdge& a, const BoundaryEdge& b) {
        const std::uint64_t ka = ends_of(a);
        const std::uint64_t kb = ends_of(b);
        return ka != kb ? ka < kb : a.from < b.from;
    });
    std::size_t left = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::uint64_t key = ends_of(edges[i]);
        const PointId lo = std::min(edges[i].from, edges[i].to);
        std::size_t j = i;
        std::size_t up = 0;
        for (; j < edges.size() && ends_of(edges[j]) == key; ++j)
            if (edges[j].from == lo) ++up;
        const std::size_t down = (j - i) - up;
        // `up` edges come first.
        for (std::size_t k = 0; cancelled != nullptr && k < std::min(up, down); ++k)
            cancelled->insert(cancelled->end(), {edges[i + up - 1 - k], edges[j - 1 - k]});
        for (std::size_t k = 0; up > down && k < up - down; ++k) edges[left++] = edges[i + k];
        for (std::size_t k = 0; down > up && k < down - up; ++k) edges[left++] = edges[i + up + k];
        i = j;
    }
    return left;
}

// Cancels opposite pairs within one region. Returns how many edges are left; they come first.
std::size_t cancel_opposites(std::span<BoundaryEdge> edges, BoundaryEdges* cancelled) {
    return edges.size() <= EdgeChains::few ? cancel_few(edges, cancelled)
                                           : cancel_many(edges, cancelled);
}

void take_over(std::span<const BoundaryEdge> before, std::size_t count, BoundaryEdges& room) {
    room.reserve(count);
    room.insert(room.end(), before.begin(), before.end());
}

}  // namespace

std::span<const BoundaryEdge> FacetJoiner::join(std::span<BoundaryEdge> edges, BoundaryEdges& room,
                                                BoundaryEdges* cancelled) {
    bool in_place = true;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        while (j < edges.size() && edges[j].facet == edges[i].facet) ++j;
        check_stop(j - i);
        const auto group = edges.subspan(i, j - i);
        i = j;
        if (in_place && parts_.facets[as_index(group[0].facet)].parts == 1) {
            chains_.arrange(group);
            continue;
        }
        if (std::exchange(in_place, false))
            take_over(edges.first(i - group.size()), edges.size(), room);
        const std::size_t first = room.size();
        join_facet(group, room, cancelled);
        chains_.arrange(std::span(room).subspan(first));
    }
    return in_place ? edges : std::span<const BoundaryEdge>(room);
}

void FacetJoiner::join_facet(std::span<BoundaryEdge> edges, BoundaryEdges& out,
                             BoundaryEdges* cancelled) {
    const BoundaryFacet& f = parts_.facets[as_index(edges[0].facet)];
    if (f.parts == 1) {  // nothing to join
        out.insert(out.end(), edges.begin(), edges.end());
        return;
    }
    const auto left = edges.first(cancel_opposites(edges, cancelled));
    if (!f.in_several_cells) {
        out.insert(out.end(), left.begin(), left.end());
        return;
    }
    const std::size_t first = out.size();
    splitter_.clear();
    for (const BoundaryEdge& e : left) {
        splitter_.add_candidate(e.from);
        splitter_.add_candidate(e.to);
    }
    splitter_.split(left, out);
    if (out.size() - first > left.size())
        out.resize(first + cancel_opposites(std::span(out).subspan(first), cancelled));
}

}  // namespace trisect::detail
