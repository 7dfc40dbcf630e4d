// SPDX-License-Identifier: Apache-2.0
//
// Where a face goes straight across a line nothing differs on its two sides, so the edges of its
// parts there cancel. That is right unless another face does the same: then the two cross in the
// interior of both, and the line is an edge of the boundary. With both of them cut there, each half
// is paired with a half of another face, by the inside between them (brep/radial_order.h). A wedge
// that merely stands on a face with its edge leaves that face alone, as every other contact of
// faces does. So it depends on the set alone where edges are.

#include <trisect/bsp/assembly/parts/crossing_faces.h>

#include <algorithm>
#include <tuple>

#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

bool are_in_one_plane(const FacetEdge& a, const FacetEdge& b) {
    if (a.source == b.source && a.facet == b.facet) return a.flipped == b.flipped;
    const Plane p = a.source->support(a.facet);
    const Plane q = b.source->support(b.facet);
    return is_same_plane(p, q) && same_orientation(p, q) == (a.flipped == b.flipped);
}

// Whether a facet has edges of its own, although it passed through: it joins with a neighbour.
bool is_among(std::span<const BoundaryFacet> facets, const Source& source, std::uint32_t facet,
              bool flipped) {
    const auto key = [](const BoundaryFacet& f) {
        return std::tuple(f.source->serial(), f.facet, f.flipped);
    };
    return std::ranges::binary_search(facets, std::tuple(source.serial(), facet, flipped), {}, key);
}

}  // namespace

bool cross_straight(std::span<const FacetEdge> edges) {
    std::vector<bool> seen(edges.size(), false);
    std::size_t straight = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (seen[i]) continue;
        bool up = false;
        bool down = false;
        for (std::size_t j = i; j < edges.size(); ++j) {
            if (seen[j] || !are_in_one_plane(edges[i], edges[j])) continue;
            seen[j] = true;
            (edges[j].up ? up : down) = true;
        }
        if (up && down && ++straight == 2) return true;
    }
    return false;
}

PoolVector<WholeFacetEdge> whole_facets_on(const BoundaryParts& parts,
                                           std::span<const BoundaryEdge> edges) {
    // An edge by its vertices in the mesh, the smaller one first.
    struct MeshEdge {
        std::size_t table;
        std::uint32_t low;
        std::uint32_t high;
        std::uint64_t ends;
        bool low_is_first;  // of the points
        [[nodiscard]] auto key() const { return std::tuple(table, low, high); }
    };
    const Workbench& bench = parts.bench;
    std::vector<MeshEdge> wanted;
    for (const BoundaryEdge& e : edges) {
        if (!bench.is_corner(e.from) || !bench.is_corner(e.to)) continue;
        const Source* const source = parts.facets[as_index(e.facet)].source;
        const auto [s, v] = bench.corner_name(e.from);
        const auto [t, w] = bench.corner_name(e.to);
        if (s != source || t != source) continue;
        wanted.push_back({parts.table_of(source), std::min(v, w), std::max(v, w), ends_of(e),
                          (v < w) == (e.from < e.to)});
    }
    std::ranges::sort(wanted, {}, &MeshEdge::key);
    PoolVector<WholeFacetEdge> out;
    for (auto first = wanted.begin(); first != wanted.end();) {
        const std::size_t table = first->table;
        const auto end = std::ranges::find_if(first, wanted.end(),
                                              [&](const MeshEdge& e) { return e.table != table; });
        const Source* const source = parts.sources[table].source();
        const LatticeMesh& mesh = source->mesh();
        std::vector<bool> is_end(mesh.points.size(), false);
        for (auto e = first; e != end; ++e) is_end[e->low] = is_end[e->high] = true;
        parts.sources[table].for_each_whole([&](std::uint32_t facet, bool flipped) {
            const auto& corners = mesh.triangles[facet];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = corners[i];
                const std::uint32_t w = corners[(i + 1) % 3];
                if (!is_end[v] || !is_end[w]) continue;
                const auto at = std::ranges::lower_bound(
                    first, end, std::tuple(table, std::min(v, w), std::max(v, w)), {},
                    &MeshEdge::key);
                if (at == end || at->low != std::min(v, w) || at->high != std::max(v, w)) continue;
                if (is_among(parts.facets, *source, facet, flipped)) break;
                const bool up = ((v < w) == at->low_is_first) != flipped;
                out.push_back({at->ends, {source, facet, flipped, up}});
            }
        });
        first = end;
    }
    std::ranges::stable_sort(out, {}, &WholeFacetEdge::ends);
    return out;
}

void put_back_crossings(const BoundaryParts& parts, std::span<const BoundaryEdge> cancelled,
                        BoundaryEdges& edges) {
    if (cancelled.empty()) return;
    std::vector<bool> is_end(parts.bench.point_count(), false);
    for (const BoundaryEdge& e : cancelled) is_end[as_index(e.from)] = true;
    struct Entry {
        std::uint64_t ends;
        bool was_cancelled;
        BoundaryEdge edge;
    };
    PoolVector<Entry> entries;
    for (const BoundaryEdge& e : cancelled) entries.push_back({ends_of(e), true, e});
    for (const BoundaryEdge& e : edges)
        if (is_end[as_index(e.from)] && is_end[as_index(e.to)])
            entries.push_back({ends_of(e), false, e});
    std::ranges::stable_sort(entries, {}, &Entry::ends);
    const std::size_t before = edges.size();
    PoolVector<FacetEdge> here;
    for (std::size_t i = 0; i < entries.size();) {
        std::size_t j = i;
        here.clear();
        for (; j < entries.size() && entries[j].ends == entries[i].ends; ++j) {
            const BoundaryEdge& e = entries[j].edge;
            const BoundaryFacet& f = parts.facets[as_index(e.facet)];
            here.push_back({f.source, f.facet, f.flipped, e.from < e.to});
        }
        // Two planes take four edges.
        const bool cross = j - i >= 4 && cross_straight(here);
        for (; i < j; ++i)
            if (cross && entries[i].was_cancelled) edges.push_back(entries[i].edge);
    }
    if (edges.size() == before) return;
    sort_by_facet(parts, edges);
    arrange_loops(edges);
}

}  // namespace trisect::detail
