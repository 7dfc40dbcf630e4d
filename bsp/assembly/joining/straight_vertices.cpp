// SPDX-License-Identifier: Apache-2.0
//
// A vertex matters only if some region turns there or touches itself; bounding planes of cells,
// lines of local cuts and the operands' own triangulation leave vertices that no region turns at.

#include <trisect/bsp/assembly/joining/straight_vertices.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include <trisect/bsp/assembly/joining/edge_parts.h>
#include <trisect/bsp/assembly/joining/straight_runs.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Leaves out points that are not kept. Loops that were in order stay so.
BoundaryEdges without_straight(const BoundaryEdges& edges, std::span<const char> keep,
                               std::span<const std::size_t> next) {
    BoundaryEdges out;
    out.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (keep[as_index(edges[i].from)] == 0) continue;
        BoundaryEdge run = edges[i];
        for (std::size_t at = i; keep[as_index(run.to)] == 0;) {
            at = next[at];
            run.to = edges[at].to;
        }
        out.push_back(run);
    }
    return out;
}

}  // namespace

void remove_straight_vertices(const BoundaryParts& parts, bool keep_corners,
                              std::span<const PointId> keep, BoundaryEdges& edges,
                              std::uint32_t threads) {
    PoolVector<char> kept(parts.bench.point_count(), 0);
    for (const PointId p : keep) kept[as_index(p)] = 1;
    const std::size_t count = count_of_edge_parts(edges.size(), threads);
    std::vector<StraightRuns> runs(count, StraightRuns(parts, keep_corners, edges, kept));
    PerThread<EdgeChains> chains;
    for_each_part(edges, threads, [&](std::size_t part, std::size_t begin, std::size_t end) {
        runs[part].look_at(begin, end, chains.local([] { return std::make_unique<EdgeChains>(); }));
    });
    const auto has_none = [](const StraightRuns& r) { return r.uncertain().empty(); };
    if (std::ranges::all_of(runs, has_none)) return;
    PoolVector<std::size_t> next(edges.size());
    ParallelParts(count, count == 1 ? 1 : threads, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) runs[i].compute(next);
        });
    const auto is_left_out = [&](const StraightRuns::Passage& d) {
        return kept[as_index(edges[d.out].from)] == 0;
    };
    if (std::ranges::any_of(runs, [&](const StraightRuns& r) {
            return std::ranges::any_of(r.uncertain(), is_left_out);
        }))
        edges = without_straight(edges, kept, next);
}

}  // namespace trisect::detail
