// SPDX-License-Identifier: Apache-2.0
//
// A region is a 2-chain, its boundary a 1-chain: the boundary of a union of parts with disjoint
// interiors is the sum of their directed edges, where opposite ones cancel. So joining needs no
// geometry but the order of points on a line. A vertex matters only if some region turns there or
// touches itself; walls of cells, lines of local cuts and the operands' own triangulation leave
// vertices that no region turns at, and those go.

#include <trisect/bsp/detail/boundary_edges.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

// Cancels opposite pairs within one region; keeps the order of what is left by (min, max, from).
void cancel_opposites(std::vector<BoundaryEdge>& edges) {
    const auto key = [](const BoundaryEdge& e) {
        return std::tuple(std::min(e.from, e.to), std::max(e.from, e.to), e.from);
    };
    std::sort(edges.begin(), edges.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<BoundaryEdge> left;
    for (std::size_t i = 0; i < edges.size();) {
        const PointId lo = std::min(edges[i].from, edges[i].to);
        const PointId hi = std::max(edges[i].from, edges[i].to);
        std::size_t j = i;
        std::size_t up = 0;
        while (j < edges.size() && std::min(edges[j].from, edges[j].to) == lo &&
               std::max(edges[j].from, edges[j].to) == hi) {
            if (edges[j].from == lo) ++up;
            ++j;
        }
        const std::size_t down = (j - i) - up;
        // `up` edges come first.
        for (std::size_t k = 0; up > down && k < up - down; ++k) left.push_back(edges[i + k]);
        for (std::size_t k = 0; down > up && k < down - up; ++k) left.push_back(edges[i + up + k]);
        i = j;
    }
    edges.swap(left);
}

void sort_by_facet(std::vector<BoundaryEdge>& edges) {
    std::stable_sort(edges.begin(), edges.end(),
                     [](const auto& a, const auto& b) { return a.facet < b.facet; });
}

// Where coincident facets of two operands meet at a wall because one of them dropped out of the
// formula beyond it, each side knows only its own vertices on the wall.
void conform_walls(const BoundaryParts& parts, std::vector<BoundaryEdge>& edges) {
    const auto on_wall = [&](const BoundaryEdge& e) {
        return parts.bench.name(e.line.plane).is_wall();
    };
    if (std::none_of(edges.begin(), edges.end(), on_wall)) return;
    std::vector<BoundaryEdge> walls;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(walls), on_wall);
    std::erase_if(edges, on_wall);
    std::vector<PointId> points;
    for (const BoundaryEdge& e : walls) {
        points.push_back(e.from);
        points.push_back(e.to);
    }
    insert_points_on_edges(parts.bench, parts.facets, points, walls);
    edges.insert(edges.end(), walls.begin(), walls.end());
    sort_by_facet(edges);
}

}  // namespace

void join_facets(const BoundaryParts& parts, std::vector<BoundaryEdge>& edges) {
    sort_by_facet(edges);
    std::vector<BoundaryEdge> out;
    out.reserve(edges.size());
    std::vector<BoundaryEdge> group;
    std::vector<PointId> points;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        while (j < edges.size() && edges[j].facet == edges[i].facet) ++j;
        group.assign(edges.begin() + static_cast<std::ptrdiff_t>(i),
                     edges.begin() + static_cast<std::ptrdiff_t>(j));
        i = j;
        const bool whole = group.size() == 3;  // one triangle, nothing to join
        if (!whole) {
            cancel_opposites(group);
            points.clear();
            for (const BoundaryEdge& e : group) points.push_back(e.from);
            for (const BoundaryEdge& e : group) points.push_back(e.to);
            insert_points_on_edges(parts.bench, parts.facets, points, group);
            cancel_opposites(group);
        }
        for (const BoundaryEdge& e : group) {
            const PlaneName& n = parts.bench.name(e.line.plane);
            if (n.is_wall() && std::abs(n.position()) >= universe_limit)
                throw UnsupportedError("the boundary is unbounded: it has no B-rep and no mesh");
        }
        out.insert(out.end(), group.begin(), group.end());
    }
    edges.swap(out);
    conform_walls(parts, edges);
}

void join_coplanar_facets(const BoundaryParts& parts, bool within_faces,
                          std::vector<BoundaryEdge>& edges) {
    std::vector<std::int32_t> cluster(parts.facets.size());
    std::iota(cluster.begin(), cluster.end(), 0);
    const auto root = [&](std::int32_t f) {
        while (cluster[u(f)] != f) f = cluster[u(f)] = cluster[u(cluster[u(f)])];
        return f;
    };
    const auto face_of = [](const BoundaryFacet& f) {
        return f.source->is_half_space() ? 0 : f.source->mesh().face_of(f.facet);
    };
    const auto belong_together = [&](std::int32_t f, std::int32_t g) {
        const BoundaryFacet& a = parts.facets[u(f)];
        const BoundaryFacet& b = parts.facets[u(g)];
        if (within_faces && (a.source != b.source || face_of(a) != face_of(b))) return false;
        const Plane& p = parts.bench.plane_at(a.support);
        const Plane& q = parts.bench.plane_at(b.support);
        return is_same_plane(p, q) && same_orientation(p, q) == (a.flipped == b.flipped);
    };
    std::vector<std::size_t> order(edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t i) {
        const BoundaryEdge& e = edges[i];
        return std::tuple(std::min(e.from, e.to), std::max(e.from, e.to), i);
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<bool> gone(edges.size(), false);
    for (std::size_t i = 0; i < order.size();) {
        std::size_t j = i + 1;
        const auto same_ends = [&](std::size_t a, std::size_t b) {
            return std::minmax(edges[a].from, edges[a].to) ==
                   std::minmax(edges[b].from, edges[b].to);
        };
        while (j < order.size() && same_ends(order[i], order[j])) ++j;
        for (std::size_t a = i; a < j; ++a) {
            for (std::size_t b = a + 1; b < j && !gone[order[a]]; ++b) {
                const BoundaryEdge& e = edges[order[a]];
                const BoundaryEdge& f = edges[order[b]];
                if (gone[order[b]] || e.from == f.from) continue;
                if (!belong_together(e.facet, f.facet)) continue;
                gone[order[a]] = gone[order[b]] = true;
                const std::int32_t x = root(e.facet);
                const std::int32_t y = root(f.facet);
                cluster[u(std::max(x, y))] = std::min(x, y);
            }
        }
        i = j;
    }
    std::vector<BoundaryEdge> left;
    left.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (gone[i]) continue;
        left.push_back(edges[i]);
        left.back().facet = root(edges[i].facet);
    }
    edges.swap(left);
    sort_by_facet(edges);
    for ([[maybe_unused]] const BoundaryEdge& e : edges)
        TRISECT_AUDIT_CHECK(within_faces || !parts.bench.name(e.line.plane).is_wall(),
                            "an edge on a cell wall survived joining");
}

void remove_straight_vertices(const BoundaryParts& parts, bool keep_corners,
                              std::vector<BoundaryEdge>& edges) {
    const Workbench& bench = parts.bench;
    std::vector<bool> keep(bench.point_count(), false);
    std::vector<std::int64_t> next(edges.size(), -1);
    std::vector<std::size_t> by_from;
    std::vector<std::size_t> by_to;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        by_from.clear();
        for (; j < edges.size() && edges[j].facet == edges[i].facet; ++j) by_from.push_back(j);
        by_to = by_from;
        std::sort(by_from.begin(), by_from.end(),
                  [&](std::size_t a, std::size_t b) { return edges[a].from < edges[b].from; });
        std::sort(by_to.begin(), by_to.end(),
                  [&](std::size_t a, std::size_t b) { return edges[a].to < edges[b].to; });
        const std::size_t n = by_from.size();
        for (std::size_t k = 0; k < n; ++k) {
            const BoundaryEdge& out = edges[by_from[k]];
            const BoundaryEdge& in = edges[by_to[k]];
            TRISECT_EXPECTS(out.from == in.to, "boundary of a face is not closed");
            const bool single = (k == 0 || edges[by_from[k - 1]].from != out.from) &&
                                (k + 1 == n || edges[by_from[k + 1]].from != out.from);
            const bool straight = single && (in.line.plane == out.line.plane ||
                                             bench.side(out.to, in.line.plane) == 0);
            if (straight) {
                next[by_to[k]] = static_cast<std::int64_t>(by_from[k]);
            } else {
                keep[u(out.from)] = true;
            }
            if (keep_corners && bench.is_corner(out.from)) keep[u(out.from)] = true;
        }
        i = j;
    }
    std::vector<BoundaryEdge> left;
    left.reserve(edges.size());
    for (const BoundaryEdge& e : edges) {
        if (!keep[u(e.from)]) continue;
        BoundaryEdge run = e;
        auto at = static_cast<std::size_t>(&e - edges.data());
        while (!keep[u(run.to)]) {
            at = static_cast<std::size_t>(next[at]);
            run.to = edges[at].to;
        }
        left.push_back(run);
    }
    edges.swap(left);
}

}  // namespace trisect::detail
