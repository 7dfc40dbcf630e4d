// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/joining/join_facets.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/joining/edge_parts.h>
#include <trisect/bsp/assembly/joining/facet_joiner.h>
#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/bsp/assembly/parts/edge_splitter.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Where coincident facets of two operands meet at a splitting plane because one of them dropped out
// of the formula beyond it, each side has only its own vertices on the splitting plane.
void conform_splitters(const BoundaryParts& parts, BoundaryEdges& edges) {
    const auto on_splitter = [&](const BoundaryEdge& e) {
        return parts.bench.name(e.line.plane).is_splitter();
    };
    BoundaryEdges splitters;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(splitters), on_splitter);
    std::erase_if(edges, on_splitter);
    EdgeSplitter splitter(parts.bench, parts.facets);
    for (const BoundaryEdge& e : splitters) {
        splitter.add_candidate(e.from);
        splitter.add_candidate(e.to);
    }
    splitter.split(splitters, edges);
    sort_by_facet(parts, edges);
}

// Whether an edge lies in a splitting plane.
bool have_splitters(const BoundaryParts& parts, std::span<const BoundaryEdge> edges) {
    bool out = false;
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        // Planes lie anywhere in memory.
        if (i + ahead < edges.size())
            __builtin_prefetch(&parts.bench.name(edges[i + ahead].line.plane));
        const PlaneName& n = parts.bench.name(edges[i].line.plane);
        if (!n.is_splitter()) continue;
        out = true;
        if (std::abs(n.position()) >= universe_limit)
            throw UnsupportedError("the boundary is unbounded: it has no B-rep and no mesh");
    }
    return out;
}
bool have_splitters(const BoundaryParts& parts, std::span<const BoundaryEdge> edges,
                    std::uint32_t threads) {
    std::atomic<bool> out{false};
    ParallelParts(edges.size(), threads, least_edges)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            if (have_splitters(parts, edges.subspan(begin, end - begin)))
                out.store(true, std::memory_order_relaxed);
        });
    return out;
}

// One part after the other.
BoundaryEdges concatenated(std::span<const std::span<const BoundaryEdge>> parts,
                           std::uint32_t threads) {
    std::vector<std::size_t> first(parts.size() + 1, 0);
    for (std::size_t i = 0; i < parts.size(); ++i) first[i + 1] = first[i] + parts[i].size();
    BoundaryEdges out(first.back());
    ParallelParts(parts.size(), threads, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                std::ranges::copy(parts[i], out.begin() + static_cast<std::ptrdiff_t>(first[i]));
        });
    return out;
}

// `cancelled`: of all facets, where it is wanted.
void join_in_parts(const BoundaryParts& parts, BoundaryEdges& edges, BoundaryEdges* cancelled,
                   std::uint32_t threads) {
    const std::size_t count = count_of_edge_parts(edges.size(), threads);
    std::vector<BoundaryEdges> rooms(count);
    std::vector<BoundaryEdges> gone(cancelled != nullptr ? count : 0);
    std::vector<std::span<const BoundaryEdge>> left(count);
    PerThread<FacetJoiner> joiners;
    for_each_part(edges, threads, [&](std::size_t part, std::size_t begin, std::size_t end) {
        left[part] = joiners.local([&] { return std::make_unique<FacetJoiner>(parts); })
                         .join(std::span(edges).subspan(begin, end - begin), rooms[part],
                               cancelled != nullptr ? &gone[part] : nullptr);
    });
    for (const BoundaryEdges& g : gone) cancelled->insert(cancelled->end(), g.begin(), g.end());
    const auto is_in_place = [&](const auto& part) {
        return part.empty() ||
               (part.data() >= edges.data() && part.data() < edges.data() + edges.size());
    };
    std::size_t size = 0;
    for (const auto& part : left) size += part.size();
    if (size == edges.size() && std::ranges::all_of(left, is_in_place)) return;
    if (count == 1) return edges.swap(rooms[0]);
    edges = concatenated(left, threads);
}

}  // namespace

void join_facets(const BoundaryParts& parts, BoundaryEdges& edges, std::uint32_t threads) {
    sort_by_facet(parts, edges);
    BoundaryEdges cancelled;
    join_in_parts(parts, edges, parts.may_have_straight_crossings ? &cancelled : nullptr, threads);
    if (!parts.are_general && have_splitters(parts, edges, threads))
        conform_splitters(parts, edges);
    put_back_crossings(parts, cancelled, edges);
    if (parts.crossings.empty()) return;
    edges.insert(edges.end(), parts.crossings.begin(), parts.crossings.end());
    sort_by_facet(parts, edges);
    arrange_loops(edges);
}

void conform_unmatched_edges(const BoundaryParts& parts, BoundaryEdges& edges) {
    const auto key = [](PointId from, PointId to) {
        return Key128{static_cast<std::uint64_t>(from), static_cast<std::uint64_t>(to)};
    };
    FlatMap known;
    for (const BoundaryEdge& e : edges) known.insert(key(e.from, e.to), 0);
    const auto is_unmatched = [&](const BoundaryEdge& e) {
        return known.find(key(e.to, e.from)) < 0;
    };
    BoundaryEdges unmatched;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(unmatched), is_unmatched);
    if (unmatched.empty()) return;
    EdgeSplitter splitter(parts.bench, parts.facets);
    for (const BoundaryEdge& e : unmatched) {
        splitter.add_candidate(e.from);
        splitter.add_candidate(e.to);
    }
    BoundaryEdges split;
    splitter.split(unmatched, split);
    if (split.size() == unmatched.size()) return;
    std::erase_if(edges, is_unmatched);
    edges.insert(edges.end(), split.begin(), split.end());
    sort_by_facet(parts, edges);
    arrange_loops(edges);
}

}  // namespace trisect::detail
