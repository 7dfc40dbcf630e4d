// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/traced/outlined_edges.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

class OutlinedEdges {
public:
    OutlinedEdges(const OutlinedFacets& outlined, const Crossings& operands,
                  std::span<const Source* const> sources, BoundaryParts& parts)
        : outlined_(outlined),
          operands_(operands),
          sources_(sources),
          parts_(parts),
          points_(outlined.vertices.size(), -1),
          planes_(operands.operands.back().first + sources.back()->facet_count(), -1) {}

    void add(const OutlinedFacets::Facet& facet, std::size_t slot, std::vector<BoundaryEdge>& out) {
        const Crossings::Operand& o = operands_.operands[slot];
        FacetMarks& marks = parts_.sources[parts_.table_of(sources_[slot])];
        const std::int32_t worked = marks.number_of_worked(facet.number - o.first, o.inside_above);
        const PlaneId own = first_edge_of(facet.number);
        BoundaryFacet& f = parts_.facets[as_index(worked)];
        f.support = parts_.bench.support_of(own);
        f.is_special = std::ranges::binary_search(operands_.special, facet.number);
        f.parts = f.is_special ? 2 : 1;
        for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e) {
            const OutlinedFacets::Edge& edge = outlined_.edges[e];
            PointId from = point(edge.from);
            PointId to = point(edge.to);
            if (o.inside_above) std::swap(from, to);
            out.push_back({from, to, worked, line_of(edge, own)});
        }
        if (o.inside_above) std::reverse(out.end() - facet.count, out.end());
        marks.set_traced(facet.number - o.first, o.inside_above);
        ++parts_.stats.traced_facets;
    }

    // A facet in special position of which all is in the result.
    void add_whole(std::uint32_t number, std::vector<BoundaryEdge>& out) {
        const std::size_t slot = operands_.operand_of(number);
        const Crossings::Operand& o = operands_.operands[slot];
        const std::size_t table = parts_.table_of(sources_[slot]);
        if (table >= parts_.sources.size()) return;  // nothing is left of it
        FacetMarks& marks = parts_.sources[table];
        const std::uint32_t facet = number - o.first;
        if (!marks.takes_part(facet, o.inside_above)) return;
        const std::int32_t worked = marks.number_of_worked(facet, o.inside_above);
        const PlaneId own = first_edge_of(number);
        BoundaryFacet& f = parts_.facets[as_index(worked)];
        f.support = parts_.bench.support_of(own);
        f.is_special = true;
        f.parts = 2;
        const PolygonRef r = ref(number);
        for (int k = 0; k < 3; ++k) {
            const int i = o.inside_above ? 2 - k : k;
            PointId from = parts_.bench.corner(r.source, r.facet, i);
            PointId to = parts_.bench.corner(r.source, r.facet, (i + 1) % 3);
            if (o.inside_above) std::swap(from, to);
            out.push_back({from, to, worked, {own + i, false}});
        }
        marks.set_traced(facet, o.inside_above);
        ++parts_.stats.traced_facets;
    }

private:
    WorkEdge line_of(const OutlinedFacets::Edge& e, PlaneId own) {
        if (e.edge >= 0) return {own + e.edge, false};
        return {support_of(e.cutter), !e.open_below};
    }

    [[nodiscard]] PolygonRef ref(std::uint32_t number) const {
        const std::size_t slot = operands_.operand_of(number);
        return {sources_[slot], nullptr, number - operands_.operands[slot].first, false, false};
    }

    // The plane of the first edge; those of the others follow it.
    PlaneId first_edge_of(std::uint32_t number) {
        PlaneId& known = planes_[number];
        if (known < 0) {
            const PolygonRef r = ref(number);
            known = parts_.bench.plane(PlaneName::edge(r.source, r.facet, 0));
        }
        return known;
    }
    PlaneId support_of(std::uint32_t number) {
        return parts_.bench.support_of(first_edge_of(number));
    }

    PointId point(std::uint32_t vertex) {
        PointId& known = points_[vertex];
        if (known < 0) known = make_point(outlined_.vertices[vertex]);
        return known;
    }
    PointId make_point(const OutlineVertex& v) {
        const PolygonRef r = ref(v.facets[0]);
        switch (v.kind) {
            case OutlineVertex::Kind::Corner:
                return parts_.bench.corner(r.source, r.facet, v.which);
            case OutlineVertex::Kind::Pierce:
                return parts_.bench.vertex(r, support_of(v.facets[0]),
                                           first_edge_of(v.facets[0]) + v.which,
                                           support_of(v.facets[1]), v.at);
            case OutlineVertex::Kind::Meeting:
                break;
        }
        return parts_.bench.vertex(r, support_of(v.facets[0]), support_of(v.facets[1]),
                                   support_of(v.facets[2]), v.at);
    }

    const OutlinedFacets& outlined_;
    const Crossings& operands_;
    std::span<const Source* const> sources_;
    BoundaryParts& parts_;
    std::vector<PointId> points_;  // by vertex, where they were asked for
    std::vector<PlaneId> planes_;  // by facet, likewise
};

}  // namespace

void add_outlined(const OutlinedFacets& outlined, const Crossings& operands,
                  std::span<const Source* const> sources, BoundaryParts& parts,
                  std::vector<BoundaryEdge>& edges) {
    check_stop(outlined.edges.size());
    edges.reserve(edges.size() + outlined.edges.size());
    OutlinedEdges all(outlined, operands, sources, parts);
    std::size_t slot = 0;
    for (const OutlinedFacets::Facet& f : outlined.facets) {
        while (slot + 1 < sources.size() && operands.operands[slot + 1].first <= f.number) ++slot;
        all.add(f, slot, edges);
    }
    auto outlined_facet = outlined.facets.begin();
    for (const std::uint32_t number : operands.special) {
        while (outlined_facet != outlined.facets.end() && outlined_facet->number < number)
            ++outlined_facet;
        if (outlined_facet == outlined.facets.end() || outlined_facet->number != number)
            all.add_whole(number, edges);
    }
}

}  // namespace trisect::detail
