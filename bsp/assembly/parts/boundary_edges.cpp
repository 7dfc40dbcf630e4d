// SPDX-License-Identifier: Apache-2.0
//
// A region is a 2-chain, its boundary a 1-chain: the boundary of a union of parts with disjoint
// interiors is the sum of their directed edges, where opposite ones cancel. So joining needs no
// geometry but the order of points on a line. A vertex matters only if some region turns there or
// touches itself; bounding planes of cells, lines of local cuts and the operands' own triangulation
// leave vertices that no region turns at, and those go.
//
// Most regions have a handful of edges: everything works on runs of one flat array.

#include <trisect/bsp/assembly/parts/boundary_edges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <iterator>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/assembly/parts/coplanar_facets.h>
#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/bsp/assembly/parts/edge_splitter.h>
#include <trisect/bsp/assembly/parts/vertex_turn.h>
#include <trisect/bsp/assembly/parts/whole_facets.h>
#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/triangle_normal.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/radix_sort.h>

namespace trisect::detail {

namespace {

// Takes what cancels, if it is wanted.
using Cancelled = BoundaryEdges;

// Cancels opposite pairs of few edges, in place; keeps the order of what is left.
std::size_t cancel_few(std::span<BoundaryEdge> edges, Cancelled* cancelled) {
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
std::size_t cancel_many(std::span<BoundaryEdge> edges, Cancelled* cancelled) {
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
std::size_t cancel_opposites(std::span<BoundaryEdge> edges, Cancelled* cancelled) {
    return edges.size() <= EdgeChains::few ? cancel_few(edges, cancelled)
                                           : cancel_many(edges, cancelled);
}

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

}  // namespace

void sort_by_facet(const BoundaryParts& parts, BoundaryEdges& edges) {
    const auto by_facet = [](const auto& a, const auto& b) { return a.facet < b.facet; };
    if (std::is_sorted(edges.begin(), edges.end(), by_facet)) return;
    PoolVector<std::size_t> fill(parts.facets.size() + 1, 0);
    for (const BoundaryEdge& e : edges) ++fill[as_index(e.facet) + 1];
    std::partial_sum(fill.begin(), fill.end(), fill.begin());
    BoundaryEdges sorted(edges.size());
    for (const BoundaryEdge& e : edges) sorted[fill[as_index(e.facet)]++] = e;
    edges.swap(sorted);
}

void arrange_loops(std::span<BoundaryEdge> edges) {
    EdgeChains chains;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        while (j < edges.size() && edges[j].facet == edges[i].facet) ++j;
        chains.arrange(edges.subspan(i, j - i));
        i = j;
    }
}

namespace {

// Fewer edges are not worth a part.
constexpr std::size_t least_edges = 8192;

// Calls work(part, begin, end) for parts of the edges; those of a facet stay together. The work may
// reorder the edges of its part.
template <class Work>
void for_each_part(std::span<const BoundaryEdge> edges, std::uint32_t threads, const Work& work) {
    const ParallelParts parts(edges.size(), threads, least_edges);
    PoolVector<std::size_t> bounds{0};
    for (std::size_t part = 1; part < parts.count(); ++part) {
        std::size_t i = std::max(bounds.back(), edges.size() * part / parts.count());
        while (i != 0 && i < edges.size() && edges[i].facet == edges[i - 1].facet) ++i;
        bounds.push_back(i);
    }
    bounds.push_back(edges.size());
    parts.for_each([&](std::size_t part, std::size_t, std::size_t) {
        work(part, bounds[part], bounds[part + 1]);
    });
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

// Joins the parts of some facets.
class FacetJoiner {
public:
    explicit FacetJoiner(const BoundaryParts& parts)
        : parts_(parts), splitter_(parts.bench, parts.facets) {}

    /// What is left of these edges, which are all those of some facets: in their own place, or in
    /// `room`.
    std::span<const BoundaryEdge> join(std::span<BoundaryEdge> edges, BoundaryEdges& room,
                                       Cancelled* cancelled) {
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

private:
    static void take_over(std::span<const BoundaryEdge> before, std::size_t count,
                          BoundaryEdges& room) {
        room.reserve(count);
        room.insert(room.end(), before.begin(), before.end());
    }

    void join_facet(std::span<BoundaryEdge> edges, BoundaryEdges& out, Cancelled* cancelled) {
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

    const BoundaryParts& parts_;
    EdgeSplitter splitter_;
    EdgeChains chains_;
};

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
void join_in_parts(const BoundaryParts& parts, BoundaryEdges& edges, Cancelled* cancelled,
                   std::uint32_t threads) {
    const std::size_t count = ParallelParts(edges.size(), threads, least_edges).count();
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
    if (have_splitters(parts, edges, threads)) conform_splitters(parts, edges);
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

namespace {

void mark_unchanged(BoundaryParts& parts, std::span<const BoundaryEdge> edges) {
    for (std::size_t i = 0; i < edges.size();) {
        BoundaryFacet& f = parts.facets[as_index(edges[i].facet)];
        std::size_t j = i;
        bool own = !f.source->is_half_space();
        for (; j < edges.size() && edges[j].facet == edges[i].facet; ++j) {
            const PointId p = edges[j].from;
            own = own && parts.bench.is_corner(p);
            bool found = false;
            for (int c = 0; own && c < 3; ++c)
                found = found || parts.bench.lattice(p) == f.source->corner(f.facet, c);
            own = own && found;
        }
        f.unchanged = own && j - i == 3;
        i = j;
    }
}

}  // namespace

void mark_unchanged_facets(BoundaryParts& parts, std::span<const BoundaryEdge> edges,
                           std::uint32_t threads) {
    for_each_part(edges, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
        mark_unchanged(parts, edges.subspan(begin, end - begin));
    });
}

namespace {

// Finds for every edge the one that runs the other way between the same ends, bounds the region on
// its other side, and is joined with it.
class CoplanarPairs {
public:
    CoplanarPairs(const BoundaryParts& parts, bool within_faces, const BoundaryEdges& edges)
        : parts_(parts), within_faces_(within_faces), edges_(edges), gone_(edges.size(), 0) {}

    /// Calls join(f, g) for the facets of every pair.
    template <class Join>
    void run(std::uint32_t threads, Join&& join) {
        list_candidates();
        make_normals(threads);
        find_pairs(threads);
        find_whole_facets(threads);
        keep_crossings();
        for (const auto& [e, f] : pairs_)
            if (gone_[e] != 0) join(edges_[e].facet, edges_[f].facet);
    }
    [[nodiscard]] bool any_gone() const { return !pairs_.empty(); }
    [[nodiscard]] bool is_gone(std::size_t edge) const { return gone_[edge] != 0; }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr std::uint32_t gone = std::uint32_t{1} << 31U;  // beside an edge in a table
    using PairOfEdges = std::pair<std::uint32_t, std::uint32_t>;
    // Edges of some ends, and what was found about them.
    struct Table {
        // Open addressing by their ends. That one is gone is put down here: several threads would
        // write to the same lines of gone_.
        PoolVector<std::uint32_t> edges;
        PoolVector<PairOfEdges> pairs;
        PoolVector<std::uint64_t> crowded;
        void make_room(std::size_t count) { edges.assign(std::bit_ceil(2 * count + 1), none); }
    };
    struct Listed {
        std::uint64_t ends = 0;
        std::uint32_t edge = 0;
    };

    // Where facets do no more than cross, nothing else has that edge.
    void list_candidates() {
        candidates_.resize(edges_.size());
        std::size_t count = 0;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const BoundaryFacet& f = parts_.facets[as_index(edges_[e].facet)];
            const PlaneId before_support = f.support - edges_[e].line.plane;
            candidates_[count] = e;
            count += !f.is_general || (before_support > 0 && before_support <= 3) ? 1 : 0;
        }
        candidates_.resize(count);
    }

    // Each table has the edges with some ends.
    void find_pairs(std::uint32_t threads) {
        const std::size_t count = parts_by_thread(candidates_.size(), threads, least_edges).count();
        std::vector<Table> tables(count);
        if (count == 1) {
            Table& all = tables[0];
            all.make_room(candidates_.size());
            enter_all(all, candidates_.size(), [&](std::size_t i) {
                return Listed{ends_of(edges_[candidates_[i]]), candidates_[i]};
            });
            pairs_ = std::move(all.pairs);
            crowded_ = std::move(all.crowded);
            return note_gone();
        }
        const std::vector<PoolVector<Listed>> lists = listed_by_table(count, threads);
        ParallelParts(count, threads, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t t = begin; t < end; ++t)
                    fill(tables[t], std::span(lists).subspan(count * t, count));
            });
        for (const Table& t : tables) {
            const auto before = static_cast<std::ptrdiff_t>(pairs_.size());
            pairs_.insert(pairs_.end(), t.pairs.begin(), t.pairs.end());
            crowded_.insert(crowded_.end(), t.crowded.begin(), t.crowded.end());
            // Each table has them in this order.
            std::ranges::inplace_merge(pairs_, pairs_.begin() + before, {}, &PairOfEdges::second);
        }
        note_gone();
    }
    void note_gone() {
        for (const auto& [e, f] : pairs_) gone_[e] = gone_[f] = 1;
    }

    // For each table a list of each part of the candidates, in their order.
    [[nodiscard]] std::vector<PoolVector<Listed>> listed_by_table(std::size_t count,
                                                                  std::uint32_t threads) const {
        std::vector<PoolVector<Listed>> lists(count * count);
        ParallelParts(count, threads, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t part = begin; part < end; ++part) list_part(part, count, lists);
            });
        return lists;
    }
    void list_part(std::size_t part, std::size_t count,
                   std::vector<PoolVector<Listed>>& lists) const {
        const std::size_t n = candidates_.size();
        std::vector<PoolVector<Listed>> own(count);
        for (PoolVector<Listed>& list : own) list.reserve(n / (count * count) * 9 / 8);
        for (std::size_t i = n * part / count; i < n * (part + 1) / count; ++i) {
            const std::uint64_t ends = ends_of(edges_[candidates_[i]]);
            own[(mix64(ends) >> 40) % count].push_back({ends, candidates_[i]});
        }
        for (std::size_t t = 0; t < count; ++t) lists[count * t + part] = std::move(own[t]);
    }

    void fill(Table& own, std::span<const PoolVector<Listed>> lists) {
        std::size_t count = 0;
        for (const PoolVector<Listed>& list : lists) count += list.size();
        own.make_room(count);
        for (const PoolVector<Listed>& list : lists)
            enter_all(own, list.size(), [&](std::size_t i) { return list[i]; });
    }

    template <class At>
    void enter_all(Table& own, std::size_t count, const At& at) {
        const std::size_t mask = own.edges.size() - 1;
        constexpr std::size_t ahead = 8;
        for (std::size_t i = 0; i < count; ++i) {
            // Both lie anywhere in memory.
            if (i + 2 * ahead < count)
                __builtin_prefetch(&own.edges[mix64(at(i + 2 * ahead).ends) & mask]);
            if (i + ahead < count) {
                const std::uint32_t known = own.edges[mix64(at(i + ahead).ends) & mask];
                if (known != none) __builtin_prefetch(&edges_[known & ~gone]);
            }
            enter(own, at(i), mix64(at(i).ends) & mask);
        }
    }

    void enter(Table& own, const Listed& listed, std::size_t slot) {
        const auto [ends, e] = listed;
        std::size_t others = 0;  // edges with the same ends that were met on the way
        for (; own.edges[slot] != none; slot = (slot + 1) & (own.edges.size() - 1)) {
            const std::uint32_t at = own.edges[slot] & ~gone;
            const bool is_gone = (own.edges[slot] & gone) != 0;
            if (ends_of(edges_[at]) != ends) continue;
            if (!is_gone && are_pair(edges_[at], edges_[e])) break;
            others += is_gone ? 2 : 1;
        }
        if (own.edges[slot] == none) {
            own.edges[slot] = e;
        } else {
            own.pairs.push_back({own.edges[slot], e});
            own.edges[slot] |= gone;
            ++others;
        }
        // The last edge of two pairs meets another one, whichever comes first in the table.
        if (others >= 2) own.crowded.push_back(ends);
    }

    [[nodiscard]] bool are_pair(const BoundaryEdge& e, const BoundaryEdge& f) const {
        return e.from == f.to && e.to == f.from && belong_together(e, f);
    }
    [[nodiscard]] bool belong_together(const BoundaryEdge& e, const BoundaryEdge& f) const {
        const BoundaryFacet& a = parts_.facets[as_index(e.facet)];
        const BoundaryFacet& b = parts_.facets[as_index(f.facet)];
        if (a.unchanged || b.unchanged) return false;
        // Where one's support cuts out the other's edge they cross.
        if (e.line.plane == b.support || f.line.plane == a.support) return false;
        if (!may_join(a, b, within_faces_)) return false;
        if (a.support == b.support) return a.flipped == b.flipped;
        if (are_surely_askew(normal_of(e.facet), normal_of(f.facet))) return false;
        if (!a.source->is_half_space() && !b.source->is_half_space())
            if (const auto alike = face_alike(a, normal_of(e.facet), b, normal_of(f.facet)))
                return *alike;
        const Plane& p = parts_.bench.plane_at(a.support);
        const Plane& q = parts_.bench.plane_at(b.support);
        return is_same_plane(p, q) && same_orientation(p, q) == (a.flipped == b.flipped);
    }

    // Of a half-space: 0, which is askew to nothing.
    [[nodiscard]] const TriangleNormal& normal_of(std::int32_t facet) const {
        return normals_[as_index(facet)];
    }
    void make_normals(std::uint32_t threads) {
        normals_.resize(parts_.facets.size());
        for_each_part(edges_, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
            std::int32_t last = -1;
            for (std::size_t i = begin; i < end; ++i) {
                const std::int32_t facet = edges_[i].facet;
                if (std::exchange(last, facet) == facet) continue;
                const BoundaryFacet& f = parts_.facets[as_index(facet)];
                if (!f.source->is_half_space())
                    normals_[as_index(facet)] = {f.source->corner(f.facet, 0).doubles(),
                                                 f.source->corner(f.facet, 1).doubles(),
                                                 f.source->corner(f.facet, 2).doubles()};
            }
        });
    }

    // Facets that pass through as they are have no edges here.
    void find_whole_facets(std::uint32_t threads) {
        BoundaryEdges inside;
        for (const auto& [e, f] : pairs_)
            if (parts_.facets[as_index(edges_[e].facet)].source ==
                parts_.facets[as_index(edges_[f].facet)].source)
                inside.push_back(edges_[e]);
        whole_ = whole_facets_on(parts_, inside, threads);
        for (const WholeFacetEdge& w : whole_) crowded_.push_back(w.ends);
    }

    // Pairs stay where facets of several planes go straight across each other. Few edges have
    // more than one other edge with the same ends.
    void keep_crossings() {
        if (pairs_.empty() || crowded_.empty()) return;
        std::ranges::sort(crowded_);
        PoolVector<std::pair<std::uint64_t, std::uint32_t>> here;
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (std::ranges::binary_search(crowded_, ends_of(edges_[e])))
                here.emplace_back(ends_of(edges_[e]), e);
        std::ranges::sort(here);
        PoolVector<FacetEdge> group;
        for (std::size_t i = 0; i < here.size();) {
            std::size_t j = i;
            group.clear();
            for (; j < here.size() && here[j].first == here[i].first; ++j) {
                const BoundaryEdge& e = edges_[here[j].second];
                const BoundaryFacet& f = parts_.facets[as_index(e.facet)];
                group.push_back({f.source, f.facet, f.flipped, e.from < e.to});
            }
            const auto first =
                std::ranges::lower_bound(whole_, here[i].first, {}, &WholeFacetEdge::ends);
            for (auto w = first; w != whole_.end() && w->ends == here[i].first; ++w)
                group.push_back(w->edge);
            const bool cross = cross_straight(group);
            for (; i < j; ++i)
                if (cross) gone_[here[i].second] = 0;
        }
    }

    const BoundaryParts& parts_;
    bool within_faces_;
    const BoundaryEdges& edges_;
    PoolVector<std::uint32_t> candidates_;  // edges that may have such a one
    PoolVector<TriangleNormal> normals_;    // by facet
    PoolVector<std::uint8_t> gone_;
    PoolVector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    PoolVector<std::uint64_t> crowded_;  // ends of more than two edges
    PoolVector<WholeFacetEdge> whole_;
};

}  // namespace

std::size_t join_coplanar_facets(const BoundaryParts& parts, bool within_faces,
                                 BoundaryEdges& edges, std::uint32_t threads) {
    check_stop(edges.size());
    PoolVector<std::int32_t> cluster(parts.facets.size());
    std::iota(cluster.begin(), cluster.end(), 0);
    const auto root = [&](std::int32_t f) {
        while (cluster[as_index(f)] != f)
            f = cluster[as_index(f)] = cluster[as_index(cluster[as_index(f)])];
        return f;
    };
    std::size_t joined = 0;
    CoplanarPairs pairs(parts, within_faces, edges);
    pairs.run(threads, [&](std::int32_t f, std::int32_t g) {
        const std::int32_t x = root(f);
        const std::int32_t y = root(g);
        if (x != y) ++joined;
        cluster[as_index(std::max(x, y))] = std::min(x, y);
    });
    if (pairs.any_gone()) {
        std::size_t left = 0;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (pairs.is_gone(i)) continue;
            edges[left] = edges[i];
            edges[left].facet = root(edges[i].facet);
            ++left;
        }
        edges.resize(left);
    }
    sort_by_facet(parts, edges);
    if (pairs.any_gone()) arrange_loops(edges);
    for ([[maybe_unused]] const BoundaryEdge& e : edges)
        TRISECT_AUDIT_CHECK(within_faces || !parts.bench.name(e.line.plane).is_splitter(),
                            "an edge on a cell splitter survived joining");
    return joined;
}

namespace {

// An edge that is the first one of a facet in a plane across an axis, which may be joined to
// others.
struct AxisFacetStart {
    std::size_t edge = 0;
    Key128 plane;  // with the side that it faces
};

void list_axis_facets(const BoundaryParts& parts, const BoundaryEdges& edges, std::size_t begin,
                      std::size_t end, PoolVector<AxisFacetStart>& out) {
    for (std::size_t i = begin; i < end; ++i) {
        if (i != begin && edges[i].facet == edges[i - 1].facet) continue;
        const BoundaryFacet& f = parts.facets[as_index(edges[i].facet)];
        if (f.unchanged) continue;
        const auto plane = axis_support(*f.source, f.facet);
        if (!plane) continue;
        const bool faces_up = (plane->sign > 0) != f.flipped;
        out.push_back({i, {2 * plane->axis + (faces_up ? 1 : 0), plane->at.bits()}});
    }
}

}  // namespace

void join_planes_across_axes(const BoundaryParts& parts, BoundaryEdges& edges,
                             std::uint32_t threads) {
    std::vector<PoolVector<AxisFacetStart>> starts(
        ParallelParts(edges.size(), threads, least_edges).count());
    for_each_part(edges, threads, [&](std::size_t part, std::size_t begin, std::size_t end) {
        list_axis_facets(parts, edges, begin, end, starts[part]);
    });
    FlatMap first_of_plane;
    bool joined = false;
    for (const auto& of_part : starts)
        for (const AxisFacetStart& start : of_part) {
            const std::int32_t number = edges[start.edge].facet;
            const std::int32_t first = first_of_plane.insert(start.plane, number).first;
            if (first == number) continue;
            joined = true;
            for (std::size_t i = start.edge; i < edges.size() && edges[i].facet == number; ++i)
                edges[i].facet = first;
        }
    if (!joined) return;
    sort_by_facet(parts, edges);
    arrange_loops(edges);
}

namespace {

// Finds the vertices at which a region only runs straight on. The names of most vertices say that
// some region turns there: of one where an edge pierces a facet, in the facets of that edge. Only
// where no region's name says so turns are computed.
class StraightRuns {
public:
    // Edges that follow each other.
    struct Passage {
        std::size_t in = 0;
        std::size_t out = 0;
    };

    StraightRuns(const BoundaryParts& parts, bool keep_corners, const BoundaryEdges& edges,
                 std::span<char> keep)
        : parts_(parts),
          bench_(parts.bench),
          keep_corners_(keep_corners),
          edges_(edges),
          keep_(keep) {}

    /// The turns of these edges, which are all those of some facets. `chains`: scratch memory, as
    /// long as there are points.
    void look_at(std::size_t first, std::size_t end, EdgeChains& chains) {
        for (std::size_t i = first; i < end;) {
            std::size_t j = i;
            while (j < end && edges_[j].facet == edges_[i].facet) ++j;
            look_at_facet(i, j, chains);
            i = j;
        }
    }

    /// Computes turns of which no name says enough. Of those that run straight on the next edge is
    /// put down, by the edge before it.
    void compute(std::span<std::size_t> next) {
        for (const Passage& d : uncertain_) {
            const PointId p = edges_[d.out].from;
            if (is_kept(p)) continue;
            if (runs_straight(edges_[d.in], edges_[d.out])) {
                next[d.in] = d.out;
            } else {
                keep(p);
            }
        }
    }

    [[nodiscard]] std::span<const Passage> uncertain() const { return uncertain_; }

private:
    using Ends = PoolVector<std::pair<PointId, std::size_t>>;

    // Other threads may keep it at the same time. What is found here does not depend on that, only
    // how much is looked at.
    [[nodiscard]] bool is_kept(PointId p) const {
        return std::atomic_ref(keep_[as_index(p)]).load(std::memory_order_relaxed) != 0;
    }
    void keep(PointId p) {
        std::atomic_ref(keep_[as_index(p)]).store(1, std::memory_order_relaxed);
    }

    void look_at_facet(std::size_t first, std::size_t end, EdgeChains& chains) {
        const auto region = std::span(edges_).subspan(first, end - first);
        if (!chains.are_simple(region)) return look_at_any(first, end);
        const PlaneId support = parts_.facets[as_index(region[0].facet)].support;
        for_each_turn(region, [&](std::size_t in, std::size_t out) {
            const PointId p = region[out].from;
            if (is_kept(p)) return;
            if ((keep_corners_ && bench_.is_corner(p)) ||
                name_tells_turn(bench_, p, support, region[in].line, region[out].line)) {
                keep(p);
            } else {
                add_passage(first + in, first + out);
            }
        });
    }

    void look_at_any(std::size_t first, std::size_t end) {
        by_from_.clear();
        by_to_.clear();
        for (std::size_t i = first; i < end; ++i) {
            by_from_.emplace_back(edges_[i].from, i);
            by_to_.emplace_back(edges_[i].to, i);
        }
        sort(by_from_);
        sort(by_to_);
        const std::size_t n = by_from_.size();
        for (std::size_t k = 0; k < n; ++k) {
            const auto [p, out] = by_from_[k];
            const auto [q, in] = by_to_[k];
            TRISECT_EXPECTS(p == q, "boundary of a face is not closed");
            const bool single = (k == 0 || by_from_[k - 1].first != p) &&
                                (k + 1 == n || by_from_[k + 1].first != p);
            if (is_kept(p)) continue;
            if (keep_corners_ && bench_.is_corner(p)) {
                keep(p);
            } else if (single) {
                add_passage(in, out);
            } else if (k + 1 == n || by_from_[k + 1].first != p) {
                add_passages_of_slit(k);
            }
        }
    }

    // Those of one point stay in the order of the edges.
    static void sort(Ends& ends) {
        constexpr std::size_t few = 256;
        if (ends.size() < few) return std::sort(ends.begin(), ends.end());
        radix_sort(ends, [](const auto& end) { return static_cast<std::uint64_t>(end.first); });
    }

    void add_passage(std::size_t in, std::size_t out) {
        if (edges_[in].from == edges_[out].to) {
            keep(edges_[out].from);  // the tip of a slit
        } else {
            uncertain_.push_back({in, out});
        }
    }

    // A vertex that several edges leave, the last of them at place k. Where these are two, and two
    // others come from where they go to, it may lie inside a line along which the region is slit.
    void add_passages_of_slit(std::size_t k) {
        const PointId p = by_from_[k].first;
        const bool two = by_from_[k - 1].first == p && (k < 2 || by_from_[k - 2].first != p);
        std::array<std::size_t, 2> in{by_to_[k - 1].second, by_to_[k].second};
        const std::array<std::size_t, 2> out{by_from_[k - 1].second, by_from_[k].second};
        if (edges_[in[0]].from == edges_[out[0]].to) std::swap(in[0], in[1]);
        if (!two || edges_[in[0]].from != edges_[out[1]].to ||
            edges_[in[1]].from != edges_[out[0]].to) {
            keep(p);
            return;
        }
        for (std::size_t i = 0; i < 2; ++i) add_passage(in[i], out[i]);
    }

    // By the corners of the facets whose supports they are. Long runs have the same two.
    [[nodiscard]] bool are_one_plane(PlaneId p, PlaneId q) {
        if (p == q) return true;
        if (std::exchange(last_planes_, {p, q}) != std::pair(p, q))
            last_are_one_ = are_one_by_corners(bench_.name(p), bench_.name(q));
        return last_are_one_;
    }
    [[nodiscard]] static bool are_one_by_corners(const PlaneName& p, const PlaneName& q) {
        const auto is_of_facet = [](const PlaneName& n) {
            return n.kind == PlaneName::Support && !n.source()->is_half_space();
        };
        if (!is_of_facet(p) || !is_of_facet(q)) return false;
        const FacetPoints facet = facet_points(*p.source(), p.facet);
        return std::ranges::all_of(facet_points(*q.source(), q.facet), [&](const Vector3& corner) {
            return side_of_facet(facet, corner) == 0;
        });
    }

    // Mostly doubles decide, and then no planes are made.
    [[nodiscard]] bool runs_straight(const BoundaryEdge& in, const BoundaryEdge& out) {
        const BoundaryFacet& f = parts_.facets[as_index(in.facet)];
        if (are_one_plane(in.line.plane, out.line.plane)) return true;
        const int k = bench_.facing(f.support).axis;
        const PlaneProjection::Axes axes{(k + 1) % 3, (k + 2) % 3};
        if (PlaneProjection::filtered_orientation(bench_.approximation(in.from),
                                                  bench_.approximation(out.from),
                                                  bench_.approximation(out.to), axes) != 0)
            return false;
        return turn_at_vertex(bench_, f.support, f.flipped, in.line, out.line) == 0;
    }

    const BoundaryParts& parts_;
    const Workbench& bench_;
    bool keep_corners_;
    const BoundaryEdges& edges_;
    std::span<char> keep_;  // by point
    PoolVector<Passage> uncertain_;
    std::pair<PlaneId, PlaneId> last_planes_{-1, -1};
    bool last_are_one_ = false;
    Ends by_from_;
    Ends by_to_;
};

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
    const std::size_t count = ParallelParts(edges.size(), threads, least_edges).count();
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
