// SPDX-License-Identifier: Apache-2.0
//
// A B-rep with maximal faces has to test every pair of neighbours for coplanarity. For facets that
// passed through, which are nearly all, that question needs no planes and no workbench: the corner
// opposite to the common edge is off the plane of the other three, and doubles can decide. Only
// facets that do join with a neighbour are turned into edges.

#include <trisect/bsp/assembly/parts/whole_facets.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <trisect/bsp/assembly/parts/broken_edges.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

using Index = BoundaryVertices::Index;

std::uint32_t face_of(const Source& source, std::uint32_t facet) { return source.face_of(facet); }

// Whether doubles can decide that d is not on the plane of a, b, c. Differences, products and sums
// are each rounded once: below 10 · 2^-53 of the sum of all products.
bool is_clearly_off(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                    const LatticePoint& d) {
    const auto vector_to = [&](const LatticePoint& p) { return minus(p.doubles(), a.doubles()); };
    const auto x = vector_to(b);
    const auto y = vector_to(c);
    const auto z = vector_to(d);
    double det = 0;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const double s = x[j] * y[k];
        const double t = x[k] * y[j];
        det += (s - t) * z[i];
        sum += (std::fabs(s) + std::fabs(t)) * std::fabs(z[i]);
    }
    return std::fabs(det) > 0x1p-49 * sum;
}

class NeighbourFinder {
public:
    NeighbourFinder(const BoundaryParts& parts, std::span<const BoundaryEdge> edges,
                    bool within_faces, BoundaryVertices& vertices, PoolVector<WholeFacet>& whole)
        : parts_(parts),
          edges_(edges),
          within_faces_(within_faces),
          vertices_(vertices),
          whole_(whole) {}

    void run() {
        sort_edges();
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
            const auto bucket = std::span(directed_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
            std::sort(bucket.begin(), bucket.end(), [](const Directed& a, const Directed& b) {
                return std::tie(a.far, a.name) < std::tie(b.far, b.name);
            });
            for (std::size_t i = 0; i < bucket.size();) {
                std::size_t j = i + 1;
                while (j < bucket.size() && bucket[j].far == bucket[i].far) ++j;
                compare_all(bucket.subspan(i, j - i));
                i = j;
            }
        }
    }

private:
    // Edge `name` of the cut facets, or after those edge name % 3 of whole facet name / 3.
    struct Directed {
        Index far = 0;  // the larger of the two vertices
        std::uint32_t name = 0;
        bool up = false;  // from the smaller to the larger one
    };

    template <class Visit>
    void for_each_edge(Visit&& visit) {
        std::uint32_t name = 0;
        for (const BoundaryEdge& e : edges_)
            visit(vertices_.of_point(e.from), vertices_.of_point(e.to), name++);
        for (const WholeFacet& w : whole_)
            for (std::size_t i = 0; i < 3; ++i)
                visit(w.corners[i], w.corners[i == 2 ? 0 : i + 1], name++);
    }

    void sort_edges() {
        begin_.assign(vertices_.size() + 1, 0);
        for_each_edge([&](Index a, Index b, std::uint32_t) { ++begin_[std::min(a, b) + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        directed_.resize(begin_.back());
        PoolVector<std::size_t> fill(begin_.begin(), begin_.end() - 1);
        for_each_edge([&](Index a, Index b, std::uint32_t name) {
            directed_[fill[std::min(a, b)]++] = {std::max(a, b), name, a < b};
        });
    }

    void compare_all(std::span<const Directed> group) {
        for (std::size_t i = 0; i < group.size(); ++i)
            for (std::size_t j = i + 1; j < group.size(); ++j)
                if (group[i].up != group[j].up) compare(group[i].name, group[j].name);
    }

    void compare(std::uint32_t a, std::uint32_t b) {
        const auto n = static_cast<std::uint32_t>(edges_.size());
        if (a < n && b < n) return;  // they have edges anyway
        if (a >= n && b >= n) {
            WholeFacet& f = whole_[(a - n) / 3];
            WholeFacet& g = whole_[(b - n) / 3];
            if (f.joins && g.joins) return;
            if (within_faces_ && !may_join(named(f), named(g), true)) return;
            if (is_clearly_off(f, (b - n) % 3, g)) return;
            if (!is_same_oriented_plane(plane(f), f.flipped, plane(g), g.flipped)) return;
            f.joins = g.joins = true;
            return;
        }
        const BoundaryFacet& cut = parts_.facets[as_index(edges_[std::min(a, b)].facet)];
        WholeFacet& f = whole_[(std::max(a, b) - n) / 3];
        if (f.joins || !may_join(cut, named(f), within_faces_)) return;
        if (is_same_oriented_plane(parts_.bench.plane_at(cut.support), cut.flipped, plane(f),
                                   f.flipped))
            f.joins = true;
    }

    [[nodiscard]] const Source& source(const WholeFacet& f) const {
        return *parts_.sources[f.table].source();
    }
    [[nodiscard]] BoundaryFacet named(const WholeFacet& f) const {
        return {&source(f), f.facet, f.flipped};
    }
    [[nodiscard]] Plane plane(const WholeFacet& f) const { return source(f).support(f.facet); }

    // The corner of g across from its edge i; i counts in the order of the result's face.
    bool is_clearly_off(const WholeFacet& f, std::uint32_t i, const WholeFacet& g) const {
        const auto corner = (g.flipped ? 4 - i : i + 2) % 3;
        return detail::is_clearly_off(source(f).corner(f.facet, 0), source(f).corner(f.facet, 1),
                                      source(f).corner(f.facet, 2),
                                      source(g).corner(g.facet, static_cast<int>(corner)));
    }

    static bool is_same_oriented_plane(const Plane& p, bool p_flipped, const Plane& q,
                                       bool q_flipped) {
        return is_same_plane(p, q) && same_orientation(p, q) == (p_flipped == q_flipped);
    }

    const BoundaryParts& parts_;
    std::span<const BoundaryEdge> edges_;
    bool within_faces_;
    BoundaryVertices& vertices_;
    PoolVector<WholeFacet>& whole_;
    PoolVector<std::size_t> begin_;
    PoolVector<Directed> directed_;
};

}  // namespace

bool may_join(const BoundaryFacet& a, const BoundaryFacet& b, bool within_faces) {
    return !within_faces ||
           (a.source == b.source && face_of(*a.source, a.facet) == face_of(*b.source, b.facet));
}

PoolVector<WholeFacet> list_whole_facets(const BoundaryParts& parts,
                                         std::span<const BoundaryEdge> edges, bool within_faces,
                                         BoundaryVertices& vertices) {
    PoolVector<WholeFacet> whole;
    whole.reserve(parts.stats.whole_facets);
    for (const BoundaryEdge& e : edges) (void)vertices.of_point(e.from);
    for (std::uint32_t t = 0; t < parts.sources.size(); ++t) {
        const LatticeMesh& mesh = parts.sources[t].source()->mesh();
        parts.sources[t].for_each_whole([&](std::uint32_t facet, bool flipped) {
            WholeFacet& w = whole.emplace_back();
            w.table = t;
            w.facet = facet;
            w.flipped = flipped;
            const auto& corners = mesh.triangles[facet];
            w.corners = {vertices.of_corner(t, corners[0]),
                         vertices.of_corner(t, corners[flipped ? 2 : 1]),
                         vertices.of_corner(t, corners[flipped ? 1 : 2])};
        });
    }
    NeighbourFinder(parts, edges, within_faces, vertices, whole).run();
    return whole;
}

void add_joining_facets(std::span<const WholeFacet> whole, std::span<const BrokenEdge> broken,
                        BoundaryVertices& vertices, BoundaryParts& parts, BoundaryEdges& edges) {
    const std::size_t old_count = parts.facets.size();
    auto next_broken = broken.begin();
    PoolVector<PointId> chain;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const WholeFacet& w = whole[n];
        if (!w.joins) continue;
        const Source* source = parts.sources[w.table].source();
        const PolygonRef ref{source, nullptr, w.facet, w.flipped, false};
        WorkPolygon shape = parts.bench.polygon(ref);
        parts.bench.with_edges(shape, ref);
        std::array<PointId, 3> points{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Index v = w.corners[i == 0 ? 0 : (w.flipped ? 3 - i : i)];
            if (vertices.point(v) < 0) vertices.set_point(v, shape.points[i]);
            points[i] = vertices.point(v);
        }
        const auto facet = static_cast<std::int32_t>(parts.facets.size());
        parts.facets.push_back({source, w.facet, w.flipped, shape.support, -1, false});
        for (std::size_t i = 0; i < 3; ++i) {
            chain = {points[i]};
            if (next_broken != broken.end() && next_broken->whole == n &&
                as_index(next_broken->edge) == i) {
                chain.insert(chain.end(), next_broken->inside.begin(), next_broken->inside.end());
                ++next_broken;
            }
            chain.push_back(points[(i + 1) % 3]);
            if (w.flipped) std::ranges::reverse(chain);
            for (std::size_t k = 1; k < chain.size(); ++k)
                edges.push_back({chain[k - 1], chain[k], facet, shape.edges[i]});
        }
    }
    if (parts.facets.size() == old_count) return;
    PoolVector<std::int32_t> order(parts.facets.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::int32_t i) {
        const BoundaryFacet& f = parts.facets[as_index(i)];
        return std::tuple(f.source->serial(), f.facet, f.flipped, i);
    };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    PoolVector<std::int32_t> place(order.size());
    PoolVector<BoundaryFacet> sorted;
    sorted.reserve(order.size());
    for (const std::int32_t i : order) {
        place[as_index(i)] = static_cast<std::int32_t>(sorted.size());
        sorted.push_back(parts.facets[as_index(i)]);
    }
    parts.facets.swap(sorted);
    for (BoundaryEdge& e : edges) e.facet = place[as_index(e.facet)];
}

}  // namespace trisect::detail
