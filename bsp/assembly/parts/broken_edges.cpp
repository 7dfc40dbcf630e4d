// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/broken_edges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// An edge of a source, by its vertices there.
struct SourceEdge {
    std::size_t table = 0;
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    friend auto operator<=>(const SourceEdge&, const SourceEdge&) = default;
};

SourceEdge edge_of(std::size_t table, const Source& source, std::uint32_t facet, int i) {
    const std::uint32_t a = source.corner_index(facet, i);
    const std::uint32_t b = source.corner_index(facet, (i + 1) % 3);
    return {table, std::min(a, b), std::max(a, b)};
}

// A part of an edge of a cut facet, from `from` to `to` along the facet.
struct Part {
    SourceEdge edge;
    std::int32_t facet = 0;
    PointId from = -1;
    PointId to = -1;
    bool starts = false;  // at the edge's own beginning
};

class BrokenEdges {
public:
    explicit BrokenEdges(const BoundaryParts& parts) : parts_(parts) {}

    // Parts of edges that have vertices inside, without those of which two facets have some.
    void read(std::span<const BoundaryEdge> edges) {
        for (const BoundaryEdge& e : edges) add(e);
        std::ranges::sort(parts_of_edges_, {},
                          [](const Part& p) { return std::tuple(p.edge, p.facet, !p.starts); });
        std::size_t kept = 0;
        for (std::size_t i = 0; i < parts_of_edges_.size();) {
            std::size_t j = i + 1;
            while (j < parts_of_edges_.size() && parts_of_edges_[j].edge == parts_of_edges_[i].edge)
                ++j;
            const bool is_of_one = parts_of_edges_[i].facet == parts_of_edges_[j - 1].facet;
            for (; i < j; ++i)
                if (is_of_one) parts_of_edges_[kept++] = parts_of_edges_[i];
        }
        parts_of_edges_.resize(kept);
    }

    [[nodiscard]] bool any() const { return !parts_of_edges_.empty(); }

    // The vertices inside an edge, from its lower vertex in the source to the higher one.
    [[nodiscard]] PoolVector<PointId> inside(const SourceEdge& edge) const {
        const auto first = std::ranges::lower_bound(parts_of_edges_, edge, {}, &Part::edge);
        const auto end =
            std::ranges::upper_bound(first, parts_of_edges_.end(), edge, {}, &Part::edge);
        const std::span<const Part> group(std::to_address(first), std::to_address(end));
        PoolVector<PointId> out;
        if (group.empty() || !group.front().starts) return out;
        const BoundaryFacet& f = parts_.facets[as_index(group.front().facet)];
        for (PointId at = group.front().to;;) {
            const auto next = std::ranges::find(group, at, &Part::from);
            if (next == group.end()) break;
            out.push_back(at);
            at = next->to;
        }
        if (starts_high(f, edge)) std::ranges::reverse(out);
        return out;
    }

private:
    void add(const BoundaryEdge& e) {
        const BoundaryFacet& f = parts_.facets[as_index(e.facet)];
        const PlaneName& name = parts_.bench.name(e.line.plane);
        if (!name.is_edge() || name.source() != f.source) return;
        const auto i = own_edge(f, name);
        if (!i) return;
        const int from = f.flipped ? (*i + 1) % 3 : *i;
        const int to = f.flipped ? *i : (*i + 1) % 3;
        const bool starts = is_corner(e.from, f, from);
        if (starts && is_corner(e.to, f, to)) return;
        parts_of_edges_.push_back({edge_of(parts_.table_of(f.source), *f.source, f.facet, *i),
                                   e.facet, e.from, e.to, starts});
    }
    // The facet's edge with the vertices of an edge that a plane is named after: that may be the
    // one of the facet across it.
    static std::optional<int> own_edge(const BoundaryFacet& f, const PlaneName& name) {
        const auto kind = static_cast<int>(name.kind);
        const std::uint32_t a = f.source->corner_index(name.facet, kind);
        const std::uint32_t b = f.source->corner_index(name.facet, (kind + 1) % 3);
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t from = f.source->corner_index(f.facet, i);
            const std::uint32_t to = f.source->corner_index(f.facet, (i + 1) % 3);
            if ((from == a && to == b) || (from == b && to == a)) return i;
        }
        return std::nullopt;
    }
    [[nodiscard]] bool is_corner(PointId p, const BoundaryFacet& f, int corner) const {
        return parts_.bench.is_lattice(p) &&
               parts_.bench.lattice(p) == f.source->corner(f.facet, corner);
    }
    // Whether the boundary of the facet's region runs from the higher vertex to the lower one.
    static bool starts_high(const BoundaryFacet& f, const SourceEdge& edge) {
        for (int i = 0; i < 3; ++i)
            if (f.source->corner_index(f.facet, i) == edge.low &&
                f.source->corner_index(f.facet, (i + 1) % 3) == edge.high)
                return f.flipped;
        return !f.flipped;
    }

    const BoundaryParts& parts_;
    std::vector<Part> parts_of_edges_;
};

}  // namespace

PoolVector<BrokenEdge> find_broken_edges(const BoundaryParts& parts,
                                         std::span<const BoundaryEdge> edges,
                                         std::span<WholeFacet> whole) {
    PoolVector<BrokenEdge> out;
    BrokenEdges broken(parts);
    broken.read(edges);
    if (!broken.any()) return out;
    for (std::size_t w = 0; w < whole.size(); ++w) {
        const Source& source = *parts.sources[whole[w].table].source();
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t from = source.corner_index(whole[w].facet, i);
            const std::uint32_t to = source.corner_index(whole[w].facet, (i + 1) % 3);
            auto inside = broken.inside({whole[w].table, std::min(from, to), std::max(from, to)});
            if (inside.empty()) continue;
            if (from > to) std::ranges::reverse(inside);
            whole[w].joins = true;
            out.push_back({w, i, std::move(inside)});
        }
    }
    return out;
}

}  // namespace trisect::detail
