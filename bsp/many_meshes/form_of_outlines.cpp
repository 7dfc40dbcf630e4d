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

// Fewer edges or vertices are not worth a part of their own.
constexpr std::size_t least_edges = 8192;
constexpr std::size_t least_vertices = 8192;

// Vertices of all parts one after the other: those that edges have get numbers in this order, and
// shared ones that of the first of them. Most are of whole facets, and not wanted.
class WantedVertices {
public:
    explicit WantedVertices(const Parts& parts) : parts_(parts) {
        for (const Part& p : parts) {
            firsts_.push_back(count_);
            count_ += p.solid.vertices.size();
        }
    }

    // With numbers of vertices in place of places among those of all parts.
    void take(OutlinedFacets& outlined, std::uint32_t threads) {
        mark(outlined.edges, threads);
        const ParallelParts parts(count_, threads, least_vertices);
        ranges_.resize(parts.count());
        parts.for_each([&](std::size_t number, std::size_t begin, std::size_t end) {
            ranges_[number].begin = begin;
            ranges_[number].end = end;
            look_at(ranges_[number]);
        });
        std::size_t all = find_copies();
        reserve_touched(outlined.vertices, all, threads);
        if (parts.count() > 1) outlined.vertices.resize(all);
        parts.for_each([&](std::size_t number, std::size_t, std::size_t) {
            write(ranges_[number], outlined.vertices);
        });
        for (const Copy& c : copies_) numbers_[c.copy] = numbers_[c.of];
        ParallelParts(outlined.edges.size(), threads, least_edges)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    OutlinedFacets::Edge& e = outlined.edges[i];
                    e.from = numbers_[e.from];
                    e.to = numbers_[e.to];
                }
            });
    }

private:
    static constexpr std::uint32_t unused = ~std::uint32_t{0};
    static constexpr std::uint32_t is_copy = unused - 1;
    struct Shared {
        std::uint32_t place = 0;
        const OutlineVertex* vertex = nullptr;
    };
    struct Range {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::size_t first = 0;  // number
        std::size_t count = 0;  // of those that get one
        std::vector<Shared> shared;
    };
    struct Copy {
        std::uint32_t copy = 0;
        std::uint32_t of = 0;
    };

    // Each is where an edge begins. Several threads mark the same ones.
    void mark(std::span<const OutlinedFacets::Edge> edges, std::uint32_t threads) {
        numbers_.assign(count_, unused);
        ParallelParts(edges.size(), threads, least_edges)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (const OutlinedFacets::Edge& e : edges.subspan(begin, end - begin))
                    std::atomic_ref(numbers_[e.from]).store(0, std::memory_order_relaxed);
            });
    }
    // Calls each(place, vertex) for those of a range.
    template <class Each>
    void for_each_wanted(const Range& range, const Each& each) const {
        auto part = static_cast<std::size_t>(std::ranges::upper_bound(firsts_, range.begin) -
                                             firsts_.begin() - 1);
        for (std::size_t at = range.begin; at < range.end; ++part) {
            const std::span<const OutlineVertex> vertices = parts_[part].solid.vertices;
            const std::size_t end = std::min(range.end, firsts_[part] + vertices.size());
            for (; at < end; ++at)
                if (numbers_[at] != unused)
                    each(static_cast<std::uint32_t>(at), vertices[at - firsts_[part]]);
        }
    }
    void look_at(Range& range) const {
        for_each_wanted(range, [&](std::uint32_t place, const OutlineVertex& v) {
            ++range.count;
            if (v.is_shared) range.shared.push_back({place, &v});
        });
    }
    // How many there are without them.
    std::size_t find_copies() {
        std::size_t shared_count = 0;
        for (const Range& r : ranges_) shared_count += r.shared.size();
        FlatMap places;
        places.reserve(shared_count);
        std::size_t next = 0;
        for (Range& r : ranges_) {
            for (const Shared& s : r.shared) {
                const auto [first, is_new] =
                    places.insert(name_of(*s.vertex), static_cast<std::int32_t>(s.place));
                if (is_new) continue;
                copies_.push_back({s.place, static_cast<std::uint32_t>(first)});
                numbers_[s.place] = is_copy;
                --r.count;
            }
            r.first = next;
            next += r.count;
        }
        return next;
    }
    void write(const Range& range, PoolVector<OutlineVertex>& vertices) {
        std::size_t next = range.first;
        for_each_wanted(range, [&](std::uint32_t place, const OutlineVertex& v) {
            if (numbers_[place] == is_copy) return;
            numbers_[place] = static_cast<std::uint32_t>(next);
            if (next == vertices.size())
                vertices.push_back(v);
            else
                vertices[next] = v;
            ++next;
        });
    }

    const Parts& parts_;
    std::size_t count_ = 0;
    std::vector<std::size_t> firsts_;    // by part
    PoolVector<std::uint32_t> numbers_;  // by place
    std::vector<Range> ranges_;
    std::vector<Copy> copies_;
};

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
    WantedVertices(parts).take(*outlined, threads);
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(operands);
    out.tree = std::move(tree);
    return out;
}

}  // namespace trisect::detail
