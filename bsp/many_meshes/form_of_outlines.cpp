// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/form_of_outlines.h>

#include <algorithm>
#include <atomic>
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

// What it has of a solid, or what has settled.
struct Part {
    OutlinedSolid solid;
    const SettledPart* settled = nullptr;
};
using Parts = std::vector<Part>;

// Settled ones, and what is not, with these once more.
Parts parts_of(const OutlineStore& store) {
    Parts out;
    const OutlinedSolid solid = store.view({});
    for (const auto& part : solid.settled) out.push_back({part->view(), part.get()});
    out.push_back({solid, nullptr});
    return out;
}

constexpr std::uint32_t unused = ~std::uint32_t{0};

// Fewer vertices or edges are not worth a part of their own.
constexpr std::size_t least_values = 8192;

// Those that are wanted, by vertex of all parts. Each is where an edge begins. Several threads mark
// the same ones.
PoolVector<std::uint32_t> wanted_vertices(const OutlinedFacets& outlined, const Parts& parts,
                                          std::uint32_t threads) {
    std::size_t all = 0;
    for (const Part& p : parts) all += p.solid.vertices.size();
    PoolVector<std::uint32_t> numbers(all, unused);
    ParallelParts(outlined.edges.size(), threads, least_values)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                std::atomic_ref(numbers[outlined.edges[i].from])
                    .store(0, std::memory_order_relaxed);
        });
    return numbers;
}

// Without settled parts none is there twice.
void take_those_of_one(OutlinedFacets& outlined, std::span<const OutlineVertex> vertices,
                       std::span<std::uint32_t> numbers, std::uint32_t threads) {
    const ParallelParts ranges(vertices.size(), threads, least_values);
    PoolVector<std::size_t> next(ranges.count());
    ranges.for_each([&](std::size_t range, std::size_t begin, std::size_t end) {
        const auto part = numbers.subspan(begin, end - begin);
        next[range] = part.size() - static_cast<std::size_t>(std::ranges::count(part, unused));
    });
    const std::size_t count = std::accumulate(next.begin(), next.end(), std::size_t{0});
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    reserve_touched(outlined.vertices, count, threads);
    outlined.vertices.resize(count);
    ranges.for_each([&](std::size_t range, std::size_t begin, std::size_t end) {
        std::size_t n = next[range];
        for (std::size_t i = begin; i < end; ++i) {
            if (numbers[i] == unused) continue;
            outlined.vertices[n] = vertices[i];
            numbers[i] = static_cast<std::uint32_t>(n++);
        }
    });
}

// Vertices of settled parts may be those of others, too.
void take_those_of_several(OutlinedFacets& outlined, const Parts& parts,
                           std::span<std::uint32_t> numbers, std::uint32_t threads) {
    reserve_touched(outlined.vertices,
                    numbers.size() - static_cast<std::size_t>(std::ranges::count(numbers, unused)),
                    threads);
    const auto for_each_wanted = [&](const auto& each) {
        std::uint32_t* number = numbers.data();
        for (const Part& p : parts)
            for (const OutlineVertex& v : p.solid.vertices) {
                if (*number != unused) each(v, *number);
                ++number;
            }
    };
    std::size_t shared_count = 0;
    for_each_wanted(
        [&](const OutlineVertex& v, std::uint32_t&) { shared_count += v.is_shared ? 1 : 0; });
    FlatMap shared;
    shared.reserve(shared_count);
    for_each_wanted([&](const OutlineVertex& v, std::uint32_t& number) {
        const auto next = static_cast<std::uint32_t>(outlined.vertices.size());
        number = next;
        if (v.is_shared)
            number = static_cast<std::uint32_t>(
                shared.insert(name_of(v), static_cast<std::int32_t>(next)).first);
        if (number == next) outlined.vertices.push_back(v);
    });
}

// Those vertices of parts that are wanted: most are of whole facets.
void take_vertices(OutlinedFacets& outlined, const Parts& parts, std::uint32_t threads) {
    PoolVector<std::uint32_t> numbers = wanted_vertices(outlined, parts, threads);
    if (parts.size() == 1)
        take_those_of_one(outlined, parts[0].solid.vertices, numbers, threads);
    else
        take_those_of_several(outlined, parts, numbers, threads);
    ParallelParts(outlined.edges.size(), threads, least_values)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                OutlinedFacets::Edge& e = outlined.edges[i];
                e.from = numbers[e.from];
                e.to = numbers[e.to];
            }
        });
}

// A facet of which there is a part.
struct CutFacet {
    std::uint32_t number = 0;
    std::uint32_t slot = 0;
    std::uint32_t part = 0;
    std::uint32_t first = 0;  // of its edges
    std::uint32_t count = 0;
    bool is_kept = false;  // as assembly takes it
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

void add_part(const Part& part, std::uint32_t number, const ManyMeshes& meshes,
              PoolVector<CutFacet>& cut, UndividedMeshes& out) {
    const auto add_whole = [&](std::uint32_t facet, std::uint32_t slot) {
        out.uncrossed[slot].facets.push_back(facet - meshes.operands->operands[slot].first);
    };
    for (const OutlinedSolid::Facet& f : part.solid.facets)
        if (f.whole)
            add_whole(f.number, f.slot);
        else
            cut.push_back({f.number, f.slot, number, f.first, f.count, false});
    if (part.settled == nullptr) return;
    for (const SettledPart::Whole& w : part.settled->kept_whole) add_whole(w.number, w.slot);
    for (const OutlinedFacets::Facet& f : part.settled->kept)
        cut.push_back({f.number, meshes.slot_of(f.number), number, f.first, f.count, true});
}

// Whole ones go to their operands. Groups of operands leave all in an order of their own.
PoolVector<CutFacet> sort_facets(const Parts& parts, const ManyMeshes& meshes,
                                 UndividedMeshes& out) {
    PoolVector<CutFacet> cut;
    std::size_t count = 0;
    for (const Part& p : parts) {
        count += static_cast<std::size_t>(
            std::ranges::count(p.solid.facets, false, &OutlinedSolid::Facet::whole));
        if (p.settled != nullptr) count += p.settled->kept.size();
    }
    cut.reserve(count);
    for (std::uint32_t i = 0; i < parts.size(); ++i) add_part(parts[i], i, meshes, cut, out);
    for (UncrossedFacets& u : out.uncrossed)
        if (!std::ranges::is_sorted(u.facets)) std::ranges::sort(u.facets);
    sort_by_number(cut, meshes.operands->operands.size());
    return cut;
}

// Edges of facets, with vertices by their numbers among those of all parts.
class EdgeLists {
public:
    EdgeLists(const Parts& parts, const ManyMeshes& meshes) : parts_(parts), meshes_(meshes) {
        std::uint32_t vertices = 0;
        for (const Part& p : parts) {
            first_vertices_.push_back(vertices);
            vertices += static_cast<std::uint32_t>(p.solid.vertices.size());
        }
    }
    void write(const CutFacet& f, OutlinedFacets::Edge* out) const {
        const std::uint32_t vertex = first_vertices_[f.part];
        if (f.is_kept) {
            for (OutlinedFacets::Edge e : kept(f)) {
                e.from += vertex;
                e.to += vertex;
                *out++ = e;
            }
            return;
        }
        const OutlinedSolid& solid = parts_[f.part].solid;
        for (const OutlinedSolid::Edge& e : others(f))
            *out++ = solid.for_assembly(meshes_, {e.from + vertex, e.to + vertex, e.origin},
                                        f.number, f.slot);
    }
    // Edges of a facet, and their lines, lie anywhere in memory.
    void prefetch(const CutFacet& f) const {
        if (f.is_kept)
            __builtin_prefetch(kept(f).data());
        else
            __builtin_prefetch(others(f).data());
    }
    void prefetch_lines(const CutFacet& f) const {
        if (f.is_kept) return;
        for (const OutlinedSolid::Edge& e : others(f))
            __builtin_prefetch(parts_[f.part].solid.line_of(e));
    }

private:
    [[nodiscard]] std::span<const OutlinedFacets::Edge> kept(const CutFacet& f) const {
        return std::span(parts_[f.part].settled->kept_edges).subspan(f.first, f.count);
    }
    [[nodiscard]] std::span<const OutlinedSolid::Edge> others(const CutFacet& f) const {
        return parts_[f.part].solid.edges.subspan(f.first, f.count);
    }

    const Parts& parts_;
    const ManyMeshes& meshes_;
    std::vector<std::uint32_t> first_vertices_;
};

void add_cut_facets(OutlinedFacets& outlined, const Parts& parts, std::span<const CutFacet> cut,
                    const ManyMeshes& meshes, std::uint32_t threads) {
    outlined.facets.reserve(cut.size());
    std::uint32_t edge_count = 0;
    for (const CutFacet& f : cut) {
        outlined.facets.push_back({f.number, edge_count, f.count});
        edge_count += f.count;
    }
    outlined.edges.resize(edge_count);
    const EdgeLists edges(parts, meshes);
    constexpr std::size_t ahead = 8;
    constexpr std::size_t least_facets = 8192;
    ParallelParts(cut.size(), threads, least_facets)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (i + 2 * ahead < cut.size()) edges.prefetch(cut[i + 2 * ahead]);
                if (i + ahead < cut.size()) edges.prefetch_lines(cut[i + ahead]);
                edges.write(cut[i], outlined.edges.data() + outlined.facets[i].first);
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
    add_cut_facets(*outlined, parts, sort_facets(parts, meshes, out), meshes, threads);
    take_vertices(*outlined, parts, threads);
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(operands);
    out.tree = std::move(tree);
    return out;
}

}  // namespace trisect::detail
