// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/form_of_outlines.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/many_meshes/outlines/settled_parts.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/touched_room.h>

namespace trisect::detail {

namespace {

using Parts = std::vector<OutlinedSolid>;

// Settled ones, and what is not, with these once more.
Parts parts_of(const OutlineStore& store) {
    Parts out;
    const OutlinedSolid solid = store.view({});
    for (const auto& part : solid.settled) out.push_back(part->view());
    out.push_back(solid);
    return out;
}

// Those vertices of parts that are wanted: most are of whole facets.
void take_vertices(OutlinedFacets& outlined, const Parts& parts, std::uint32_t threads) {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    std::size_t all = 0;
    for (const OutlinedSolid& p : parts) all += p.vertices.size();
    PoolVector<std::uint32_t> numbers(all, unused);
    for (const OutlinedFacets::Edge& e : outlined.edges) numbers[e.from] = numbers[e.to] = 0;
    reserve_touched(outlined.vertices,
                    static_cast<std::size_t>(std::ranges::count(numbers, std::uint32_t{0})),
                    threads);
    FlatMap shared;
    std::uint32_t* number = numbers.data();
    const auto take = [&](const OutlineVertex& v) {
        const auto next = static_cast<std::uint32_t>(outlined.vertices.size());
        *number = next;
        if (v.is_shared)
            *number = static_cast<std::uint32_t>(
                shared.insert(name_of(v), static_cast<std::int32_t>(next)).first);
        if (*number == next) outlined.vertices.push_back(v);
    };
    for (const OutlinedSolid& p : parts)
        for (const OutlineVertex& v : p.vertices) {
            if (*number != unused) take(v);
            ++number;
        }
    for (OutlinedFacets::Edge& e : outlined.edges) {
        e.from = numbers[e.from];
        e.to = numbers[e.to];
    }
}

// A facet of which there is a part.
struct CutFacet {
    std::uint32_t number = 0;
    std::uint32_t slot = 0;
    std::uint32_t part = 0;
    std::uint32_t first = 0;  // of its edges
    std::uint32_t count = 0;
};

// Groups of operands leave them in an order of their own, those of one operand mostly ascending.
void sort_by_number(PoolVector<CutFacet>& facets, std::size_t slots) {
    if (std::ranges::is_sorted(facets, {}, &CutFacet::number)) return;
    PoolVector<std::uint32_t> next(slots + 1, 0);
    for (const CutFacet& f : facets) ++next[f.slot + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    PoolVector<CutFacet> sorted(facets.size());
    for (const CutFacet& f : facets) sorted[next[f.slot]++] = f;
    facets.swap(sorted);
    if (!std::ranges::is_sorted(facets, {}, &CutFacet::number))
        std::ranges::sort(facets, {}, &CutFacet::number);
}

// Whole ones go to their operands. Groups of operands leave all in an order of their own.
PoolVector<CutFacet> sort_facets(const Parts& parts, const Crossings& operands,
                                 UndividedMeshes& out) {
    PoolVector<CutFacet> cut;
    std::size_t count = 0;
    for (const OutlinedSolid& p : parts)
        count += static_cast<std::size_t>(
            std::ranges::count(p.facets, false, &OutlinedSolid::Facet::whole));
    cut.reserve(count);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (const OutlinedSolid::Facet& f : parts[i].facets)
            if (f.whole)
                out.uncrossed[f.slot].facets.push_back(f.number - operands.operands[f.slot].first);
            else
                cut.push_back({f.number, f.slot, i, f.first, f.count});
    for (const auto& part : parts.back().settled)
        for (const SettledPart::Whole& w : part->whole_open)
            out.uncrossed[w.slot].facets.push_back(w.number - operands.operands[w.slot].first);
    for (UncrossedFacets& u : out.uncrossed)
        if (!std::ranges::is_sorted(u.facets)) std::ranges::sort(u.facets);
    sort_by_number(cut, operands.operands.size());
    return cut;
}

// With vertices by their numbers among those of all parts.
void add_cut_facets(OutlinedFacets& outlined, const Parts& parts, std::span<const CutFacet> cut,
                    const ManyMeshes& meshes, std::uint32_t threads) {
    outlined.facets.reserve(cut.size());
    std::uint32_t edge_count = 0;
    for (const CutFacet& f : cut) {
        outlined.facets.push_back({f.number, edge_count, f.count});
        edge_count += f.count;
    }
    outlined.edges.resize(edge_count);
    std::vector<std::uint32_t> first_vertices{0};
    for (const OutlinedSolid& p : parts)
        first_vertices.push_back(first_vertices.back() +
                                 static_cast<std::uint32_t>(p.vertices.size()));
    // Edges of a facet, and their lines, lie anywhere in memory.
    constexpr std::size_t ahead = 8;
    const auto look_ahead = [&](std::size_t i) {
        if (i + 2 * ahead < cut.size())
            __builtin_prefetch(&parts[cut[i + 2 * ahead].part].edges[cut[i + 2 * ahead].first]);
        if (i + ahead >= cut.size()) return;
        const CutFacet& f = cut[i + ahead];
        for (const OutlinedSolid::Edge& e : parts[f.part].edges.subspan(f.first, f.count))
            __builtin_prefetch(e.origin.line());
    };
    const auto add = [&](const CutFacet& f, OutlinedFacets::Edge* out) {
        const std::uint32_t vertex = first_vertices[f.part];
        for (const OutlinedSolid::Edge& e : parts[f.part].edges.subspan(f.first, f.count)) {
            const FacetCrossing* line = e.origin.line();
            const std::uint32_t cutter =
                line == nullptr ? 0 : line->facets[line->facets[0] == f.number ? 1 : 0];
            const bool open_below =
                line != nullptr && meshes.is_open_below(meshes.slot_of(cutter), f.slot);
            *out++ = {vertex + e.from, vertex + e.to, cutter, e.origin.own(), open_below};
        }
    };
    constexpr std::size_t least_facets = 8192;
    ParallelParts(cut.size(), threads, least_facets)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                look_ahead(i);
                add(cut[i], outlined.edges.data() + outlined.facets[i].first);
            }
        });
}

}  // namespace

UndividedMeshes form_of(const OutlineStore& store, const ManyMeshes& meshes,
                        const Crossings& operands, std::shared_ptr<const LazyTree> tree,
                        std::uint32_t threads) {
    UndividedMeshes out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i)
        out.uncrossed.push_back({meshes.sources[i], operands.operands[i].inside_above, {}});
    auto outlined = std::make_shared<OutlinedFacets>();
    const Parts parts = parts_of(store);
    add_cut_facets(*outlined, parts, sort_facets(parts, operands, out), meshes, threads);
    take_vertices(*outlined, parts, threads);
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(operands);
    out.tree = std::move(tree);
    return out;
}

}  // namespace trisect::detail
