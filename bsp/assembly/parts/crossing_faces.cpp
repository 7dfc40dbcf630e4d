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
#include <array>
#include <tuple>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
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

namespace {

// An edge of a facet's outline by its vertices in the mesh, the smaller one first.
struct MeshEdge {
    std::size_t table = 0;
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint64_t ends = 0;
    bool low_is_first = false;  // of the points
    [[nodiscard]] auto key() const { return std::tuple(table, low, high); }
};

// Those edges that are edges of their facets' mesh, by mesh.
std::vector<MeshEdge> edges_of_meshes(const BoundaryParts& parts,
                                      std::span<const BoundaryEdge> edges) {
    const Workbench& bench = parts.bench;
    std::vector<MeshEdge> out;
    for (const BoundaryEdge& e : edges) {
        if (!bench.is_corner(e.from) || !bench.is_corner(e.to)) continue;
        const Source* const source = parts.facets[as_index(e.facet)].source;
        const auto [s, v] = bench.corner_name(e.from);
        const auto [t, w] = bench.corner_name(e.to);
        if (s != source || t != source) continue;
        out.push_back({parts.table_of(source), std::min(v, w), std::max(v, w), ends_of(e),
                       (v < w) == (e.from < e.to)});
    }
    std::ranges::sort(out, {}, &MeshEdge::key);
    return out;
}

// Fewer groups of eight facets are not worth a part.
constexpr std::size_t least_whole_groups = 4096;

// Of one mesh, facet by facet.
void list_whole_facets_on(const BoundaryParts& parts, std::span<const MeshEdge> wanted,
                          std::uint32_t threads, PoolVector<WholeFacetEdge>& out) {
    const std::size_t table = wanted.front().table;
    const FacetMarks& marks = parts.sources[table];
    const Source* const source = marks.source();
    const LatticeMesh& mesh = source->mesh();
    std::vector<bool> is_end(mesh.points.size(), false);
    for (const MeshEdge& e : wanted) is_end[e.low] = is_end[e.high] = true;
    const auto look_at = [&](std::uint32_t facet, bool flipped, PoolVector<WholeFacetEdge>& found) {
        const auto& corners = mesh.triangles[facet];
        // Of nearly all facets at most one corner is an end: no branch before that is known.
        const std::array<int, 3> ends{is_end[corners[0]] ? 1 : 0, is_end[corners[1]] ? 1 : 0,
                                      is_end[corners[2]] ? 1 : 0};
        if (ends[0] + ends[1] + ends[2] < 2) [[likely]]
            return;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = corners[i];
            const std::uint32_t w = corners[(i + 1) % 3];
            if (ends[i] + ends[(i + 1) % 3] < 2) continue;
            const auto key = std::tuple(table, std::min(v, w), std::max(v, w));
            const auto at = std::ranges::lower_bound(wanted, key, {}, &MeshEdge::key);
            if (at == wanted.end() || at->key() != key) continue;
            if (is_among(parts.facets, *source, facet, flipped)) break;
            const bool up = ((v < w) == at->low_is_first) != flipped;
            found.push_back({at->ends, {source, facet, flipped, up}});
        }
    };
    const ParallelParts groups(marks.group_count(), threads, least_whole_groups);
    std::vector<PoolVector<WholeFacetEdge>> found(groups.count());
    groups.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        marks.for_each_whole(begin, end, [&](std::uint32_t facet, bool flipped) {
            look_at(facet, flipped, found[part]);
        });
    });
    for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
}

}  // namespace

PoolVector<WholeFacetEdge> whole_facets_on(const BoundaryParts& parts,
                                           std::span<const BoundaryEdge> edges,
                                           std::uint32_t threads) {
    const std::vector<MeshEdge> wanted = edges_of_meshes(parts, edges);
    PoolVector<WholeFacetEdge> out;
    for (std::size_t first = 0; first < wanted.size();) {
        std::size_t end = first;
        while (end < wanted.size() && wanted[end].table == wanted[first].table) ++end;
        list_whole_facets_on(parts, std::span(wanted).subspan(first, end - first), threads, out);
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
