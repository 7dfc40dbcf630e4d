// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/joining/coplanar_pairs.h>

#include <algorithm>
#include <bit>

#include <trisect/bsp/assembly/joining/edge_parts.h>
#include <trisect/bsp/assembly/parts/coplanar_facets.h>
#include <trisect/bsp/assembly/parts/whole_facets.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

// Edges of some ends, and what was found about them.
struct CoplanarPairs::Table {
    // Open addressing by their ends. That one is gone is put down here: several threads would
    // write to the same lines of gone_.
    PoolVector<std::uint32_t> edges;
    PoolVector<PairOfEdges> pairs;
    PoolVector<std::uint64_t> crowded;
    void make_room(std::size_t count) { edges.assign(std::bit_ceil(2 * count + 1), none); }
};

void CoplanarPairs::find(std::uint32_t threads) {
    list_candidates();
    make_normals(threads);
    find_pairs(threads);
    find_whole_facets(threads);
    keep_crossings();
}

// Where facets do no more than cross, nothing else has that edge.
void CoplanarPairs::list_candidates() {
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
void CoplanarPairs::find_pairs(std::uint32_t threads) {
    const std::size_t count = parts_by_thread(candidates_.size(), threads, least_edges / 2).count();
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
    const Lists lists = listed_by_table(count, threads);
    ParallelParts(count, threads, 1).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            fill(tables[t], std::span(lists).subspan(count * t, count));
    });
    const auto comes_first = [](const PairOfEdges& a, const PairOfEdges& b) {
        return a.second < b.second;
    };
    for (const Table& t : tables) {
        const auto before = static_cast<std::ptrdiff_t>(pairs_.size());
        pairs_.insert(pairs_.end(), t.pairs.begin(), t.pairs.end());
        crowded_.insert(crowded_.end(), t.crowded.begin(), t.crowded.end());
        // Each table has them in this order.
        std::inplace_merge(pairs_.begin(), pairs_.begin() + before, pairs_.end(), comes_first);
    }
    note_gone();
}
void CoplanarPairs::note_gone() {
    for (const auto& [e, f] : pairs_) gone_[e] = gone_[f] = 1;
}

// For each table a list of each part of the candidates, in their order.
auto CoplanarPairs::listed_by_table(std::size_t count, std::uint32_t threads) const -> Lists {
    Lists lists(count * count);
    ParallelParts(count, threads, 1).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) list_part(part, count, lists);
    });
    return lists;
}
void CoplanarPairs::list_part(std::size_t part, std::size_t count, Lists& lists) const {
    const std::size_t n = candidates_.size();
    std::vector<PoolVector<Listed>> own(count);
    for (PoolVector<Listed>& list : own) list.reserve(n / (count * count) * 9 / 8);
    for (std::size_t i = n * part / count; i < n * (part + 1) / count; ++i) {
        const std::uint64_t ends = ends_of(edges_[candidates_[i]]);
        own[(mix64(ends) >> 40) % count].push_back({ends, candidates_[i]});
    }
    for (std::size_t t = 0; t < count; ++t) lists[count * t + part] = std::move(own[t]);
}

void CoplanarPairs::fill(Table& own, std::span<const PoolVector<Listed>> lists) {
    std::size_t count = 0;
    for (const PoolVector<Listed>& list : lists) count += list.size();
    own.make_room(count);
    for (const PoolVector<Listed>& list : lists)
        enter_all(own, list.size(), [&](std::size_t i) { return list[i]; });
}

template <class At>
void CoplanarPairs::enter_all(Table& own, std::size_t count, const At& at) {
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

void CoplanarPairs::enter(Table& own, const Listed& listed, std::size_t slot) {
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

bool CoplanarPairs::are_pair(const BoundaryEdge& e, const BoundaryEdge& f) const {
    return e.from == f.to && e.to == f.from && belong_together(e, f);
}
bool CoplanarPairs::belong_together(const BoundaryEdge& e, const BoundaryEdge& f) const {
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

const TriangleNormal& CoplanarPairs::normal_of(std::int32_t facet) const {
    return normals_[as_index(facet)];
}
void CoplanarPairs::make_normals(std::uint32_t threads) {
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
void CoplanarPairs::find_whole_facets(std::uint32_t threads) {
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
void CoplanarPairs::keep_crossings() {
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

}  // namespace trisect::detail
