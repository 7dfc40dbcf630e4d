// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/joining/join_coplanar_facets.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include <trisect/bsp/assembly/joining/coplanar_pairs.h>
#include <trisect/bsp/assembly/joining/edge_parts.h>
#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

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
    pairs.find(threads);
    pairs.for_each_joined([&](std::int32_t f, std::int32_t g) {
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
    std::vector<PoolVector<AxisFacetStart>> starts(count_of_edge_parts(edges.size(), threads));
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

}  // namespace trisect::detail
