// SPDX-License-Identifier: Apache-2.0
//
// Vertices and facets have their numbers already, one for each, so nothing is looked up by name;
// corners are, where facets in special position that are whole share them.

#include <trisect/bsp/assembly/traced/outlined_edges.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/assembly/traced/operand_table.h>
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
          operand_of_(operands.operands),
          sources_(sources),
          parts_(parts),
          points_(outlined.vertices.size(), -1),
          planes_(operands.operands.back().first + sources.back()->facet_count(), -1),
          corners_(operands.special.empty() ? 0 : sources.size()) {
        parts.bench.reserve_unnamed(4 * parts.facets.size(), outlined.vertices.size());
    }

    void add(const OutlinedFacets::Facet& facet, std::size_t slot, BoundaryEdges& out) {
        const Crossings::Operand& o = operands_.operands[slot];
        FacetMarks& marks = marks_of(slot);
        const std::int32_t worked = marks.number_of_worked(facet.number - o.first, o.inside_above);
        const PlaneId own = first_edge_of(facet.number, slot);
        BoundaryFacet& f = parts_.facets[as_index(worked)];
        f.support = support_behind(own);
        f.is_special = std::ranges::binary_search(operands_.special, facet.number);
        f.is_general = !f.is_special;
        f.parts = f.is_special ? 2 : 1;
        for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e) {
            look_ahead(e);
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
    void add_whole(std::uint32_t number, BoundaryEdges& out) {
        const std::size_t slot = operand_of_(number);
        const Crossings::Operand& o = operands_.operands[slot];
        const std::size_t table = parts_.table_of(sources_[slot]);
        if (table >= parts_.sources.size()) return;  // nothing is left of it
        FacetMarks& marks = parts_.sources[table];
        const std::uint32_t facet = number - o.first;
        if (!marks.takes_part(facet, o.inside_above)) return;
        const std::int32_t worked = marks.number_of_worked(facet, o.inside_above);
        const PlaneId own = first_edge_of(number, slot);
        BoundaryFacet& f = parts_.facets[as_index(worked)];
        f.support = support_behind(own);
        f.is_special = true;
        f.parts = 2;
        for (int k = 0; k < 3; ++k) {
            const int i = o.inside_above ? 2 - k : k;
            PointId from = corner(slot, facet, i);
            PointId to = corner(slot, facet, (i + 1) % 3);
            if (o.inside_above) std::swap(from, to);
            out.push_back({from, to, worked, {own + i, false}});
        }
        marks.set_traced(facet, o.inside_above);
        ++parts_.stats.traced_facets;
    }

private:
    // Vertices lie anywhere in memory.
    void look_ahead(std::uint32_t edge) const {
        constexpr std::size_t ahead = 12;
        if (edge + ahead < outlined_.edges.size())
            __builtin_prefetch(&outlined_.vertices[outlined_.edges[edge + ahead].from]);
    }
    WorkEdge line_of(const OutlinedFacets::Edge& e, PlaneId own) {
        if (e.edge >= 0) return {own + e.edge, false};
        return {support_of(e.cutter), !e.open_below};
    }

    FacetMarks& marks_of(std::size_t slot) {
        if (slot != marked_slot_ || marks_ == nullptr) {
            marks_ = &parts_.sources[parts_.table_of(sources_[slot])];
            marked_slot_ = slot;
        }
        return *marks_;
    }

    // The plane of the first edge; those of the others follow it, and the support.
    PlaneId first_edge_of(std::uint32_t number, std::size_t slot) {
        PlaneId& known = planes_[number];
        if (known < 0)
            known = parts_.bench.add_facet(sources_[slot], number - operands_.operands[slot].first);
        return known;
    }
    PlaneId first_edge_of(std::uint32_t number) {
        const PlaneId known = planes_[number];
        return known >= 0 ? known : first_edge_of(number, operand_of_(number));
    }
    // Without a look at the plane, which lies anywhere in memory.
    static PlaneId support_behind(PlaneId first_edge) { return first_edge + 3; }
    PlaneId support_of(std::uint32_t number) { return support_behind(first_edge_of(number)); }

    PointId point(std::uint32_t vertex) {
        PointId& known = points_[vertex];
        if (known < 0) known = make_point(outlined_.vertices[vertex]);
        return known;
    }
    PointId make_point(const OutlineVertex& v) {
        switch (v.kind) {
            case OutlineVertex::Kind::Corner: {
                const std::size_t slot = operand_of_(v.facets[0]);
                return corner(slot, v.facets[0] - operands_.operands[slot].first, v.which);
            }
            case OutlineVertex::Kind::Pierce: {
                const PlaneId own = first_edge_of(v.facets[0]);
                return parts_.bench.add_point(support_behind(own), own + v.which,
                                              support_of(v.facets[1]), v.at);
            }
            case OutlineVertex::Kind::Meeting:
                break;
        }
        return parts_.bench.add_point(support_of(v.facets[0]), support_of(v.facets[1]),
                                      support_of(v.facets[2]), v.at);
    }
    PointId corner(std::size_t slot, std::uint32_t facet, int i) {
        const Source& source = *sources_[slot];
        const std::uint32_t vertex = source.corner_index(facet, i);
        if (corners_.empty()) return parts_.bench.add_corner(&source, vertex);
        if (corners_[slot].empty()) corners_[slot].resize(source.mesh().points.size(), -1);
        PointId& known = corners_[slot][vertex];
        if (known < 0) known = parts_.bench.add_corner(&source, vertex);
        return known;
    }

    const OutlinedFacets& outlined_;
    const Crossings& operands_;
    const OperandTable operand_of_;
    std::span<const Source* const> sources_;
    BoundaryParts& parts_;
    PoolVector<PointId> points_;                // by vertex, where they were asked for
    PoolVector<PlaneId> planes_;                // by facet, likewise
    std::vector<PoolVector<PointId>> corners_;  // by slot and vertex, where facets may share them
    FacetMarks* marks_ = nullptr;               // of the last slot
    std::size_t marked_slot_ = 0;
};

}  // namespace

void add_outlined(const OutlinedFacets& outlined, const Crossings& operands,
                  std::span<const Source* const> sources, BoundaryParts& parts,
                  BoundaryEdges& edges) {
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
