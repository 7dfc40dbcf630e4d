// SPDX-License-Identifier: Apache-2.0
//
// Vertices and facets have their numbers already, one for each, so nothing is looked up by name;
// corners are, where facets in special position that are whole share them. Without such facets
// numbers say everything before anything is made, and several threads make planes, points and
// edges.

#include <trisect/bsp/assembly/traced/outlined_edges.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include <trisect/bsp/assembly/traced/operand_table.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/touched_room.h>

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

// Without facets in special position: the point of a vertex has the number of the vertex, and
// facets have planes in the order of their numbers.
class OutlinedByNumber {
public:
    OutlinedByNumber(const OutlinedFacets& outlined, const Crossings& operands,
                     std::span<const Source* const> sources, BoundaryParts& parts,
                     std::uint32_t threads)
        : outlined_(outlined),
          operands_(operands),
          sources_(sources),
          parts_(parts),
          threads_(threads),
          operand_of_(operands.operands),
          planes_(operands.operands.back().first + sources.back()->facet_count(), unused) {}

    void add(BoundaryEdges& edges) {
        mark_facets();
        room_ = parts_.bench.make_room(number_facets(), outlined_.vertices.size());
        if (threads_ != 1) parts_.bench.share();
        for_each(planes_.size(),
                 [&](std::size_t begin, std::size_t end) { put_planes(begin, end); });
        for_each(outlined_.vertices.size(),
                 [&](std::size_t begin, std::size_t end) { put_points(begin, end); });
        if (threads_ != 1) parts_.bench.end_sharing();
        add_edges(edges);
        mark_traced();
    }

private:
    static constexpr PlaneId unused = -1;
    static constexpr std::size_t least_values = 4096;  // fewer are not worth a part

    template <class Work>
    void for_each(std::size_t size, const Work& work) const {
        ParallelParts(size, threads_, least_values)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) { work(begin, end); });
    }

    // Several threads mark the same ones.
    void mark(std::uint32_t number) {
        const std::atomic_ref plane(planes_[number]);
        if (plane.load(std::memory_order_relaxed) == unused)
            plane.store(0, std::memory_order_relaxed);
    }
    void mark_facets() {
        for_each(outlined_.facets.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) mark(outlined_.facets[i].number);
        });
        for_each(outlined_.edges.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (outlined_.edges[i].edge < 0) mark(outlined_.edges[i].cutter);
        });
        for_each(outlined_.vertices.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const OutlineVertex& v = outlined_.vertices[i];
                for (std::size_t k = 0; k < facets_of(v.kind); ++k) mark(v.facets[k]);
            }
        });
    }
    // Whose planes the point of such a vertex needs.
    static std::size_t facets_of(OutlineVertex::Kind kind) {
        if (kind == OutlineVertex::Kind::Corner) return 0;
        return kind == OutlineVertex::Kind::Pierce ? 2 : 3;
    }

    // Returns how many are marked; of those the first plane is put down.
    std::size_t number_facets() {
        const ParallelParts parts(planes_.size(), threads_, least_values);
        PoolVector<std::size_t> before(parts.count() + 1, 0);
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            const auto here = std::span(planes_).subspan(begin, end - begin);
            before[part + 1] =
                here.size() - static_cast<std::size_t>(std::ranges::count(here, unused));
        });
        std::partial_sum(before.begin(), before.end(), before.begin());
        const auto first = static_cast<PlaneId>(parts_.bench.plane_count());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            auto next = first + static_cast<PlaneId>(4 * before[part]);
            for (PlaneId& plane : std::span(planes_).subspan(begin, end - begin))
                if (plane != unused) plane = std::exchange(next, next + 4);
        });
        return before.back();
    }

    void put_planes(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (planes_[i] == unused) continue;
            const auto number = static_cast<std::uint32_t>(i);
            const std::size_t slot = operand_of_(number);
            parts_.bench.put_facet(planes_[i], sources_[slot],
                                   number - operands_.operands[slot].first);
        }
    }

    [[nodiscard]] PlaneId support_of(std::uint32_t number) const { return planes_[number] + 3; }

    void put_points(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const OutlineVertex& v = outlined_.vertices[i];
            const PointId id = room_.first_point + static_cast<PointId>(i);
            switch (v.kind) {
                case OutlineVertex::Kind::Corner: {
                    const std::size_t slot = operand_of_(v.facets[0]);
                    const Source* const source = sources_[slot];
                    const std::uint32_t facet = v.facets[0] - operands_.operands[slot].first;
                    parts_.bench.put_corner(id, source, source->corner_index(facet, v.which));
                    break;
                }
                case OutlineVertex::Kind::Pierce:
                    parts_.bench.put_point(id, support_of(v.facets[0]),
                                           planes_[v.facets[0]] + v.which, support_of(v.facets[1]),
                                           v.at);
                    break;
                case OutlineVertex::Kind::Meeting:
                    parts_.bench.put_point(id, support_of(v.facets[0]), support_of(v.facets[1]),
                                           support_of(v.facets[2]), v.at);
                    break;
            }
        }
    }

    void add_edges(BoundaryEdges& edges) {
        const ParallelParts parts(outlined_.facets.size(), threads_, least_values / 2);
        if (parts.count() == 1) {
            edges.reserve(edges.size() + outlined_.edges.size());
            add_edges_of(0, outlined_.facets.size(),
                         [&](const BoundaryEdge& e) { edges.push_back(e); });
            return;
        }
        PoolVector<std::size_t> before(parts.count() + 1, edges.size());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) count += outlined_.facets[i].count;
            before[part + 1] = count;
        });
        std::partial_sum(before.begin(), before.end(), before.begin());
        reserve_touched(edges, before.back() - edges.size(), threads_);
        edges.resize(before.back());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            BoundaryEdge* out = edges.data() + before[part];
            add_edges_of(begin, end, [&](const BoundaryEdge& e) { *out++ = e; });
        });
    }

    // Facets come in the order of their operands.
    template <class Put>
    void add_edges_of(std::size_t begin, std::size_t end, const Put& put) {
        std::size_t slot = sources_.size();
        const FacetMarks* marks = nullptr;
        for (std::size_t i = begin; i < end; ++i) {
            const OutlinedFacets::Facet& facet = outlined_.facets[i];
            if (const std::size_t next = operand_of_(facet.number); next != slot) {
                slot = next;
                marks = &parts_.sources[parts_.table_of(sources_[slot])];
            }
            const Crossings::Operand& o = operands_.operands[slot];
            const std::int32_t worked =
                marks->number_of_worked(facet.number - o.first, o.inside_above);
            BoundaryFacet& f = parts_.facets[as_index(worked)];
            f.support = support_of(facet.number);
            f.is_general = true;
            f.parts = 1;
            for (std::uint32_t e = 0; e < facet.count; ++e)
                put(edge_of(facet, o.inside_above ? facet.count - 1 - e : e, worked,
                            o.inside_above));
        }
    }
    [[nodiscard]] BoundaryEdge edge_of(const OutlinedFacets::Facet& facet, std::uint32_t place,
                                       std::int32_t worked, bool is_flipped) const {
        const OutlinedFacets::Edge& e = outlined_.edges[facet.first + place];
        const PointId from = room_.first_point + static_cast<PointId>(e.from);
        const PointId to = room_.first_point + static_cast<PointId>(e.to);
        const WorkEdge line = e.edge >= 0 ? WorkEdge{planes_[facet.number] + e.edge, false}
                                          : WorkEdge{support_of(e.cutter), !e.open_below};
        return {is_flipped ? to : from, is_flipped ? from : to, worked, line};
    }

    void mark_traced() {
        for (const OutlinedFacets::Facet& f : outlined_.facets) {
            const std::size_t slot = operand_of_(f.number);
            const Crossings::Operand& o = operands_.operands[slot];
            if (slot != marked_slot_) marks_ = &parts_.sources[parts_.table_of(sources_[slot])];
            marked_slot_ = slot;
            marks_->set_traced(f.number - o.first, o.inside_above);
        }
        parts_.stats.traced_facets += outlined_.facets.size();
    }

    const OutlinedFacets& outlined_;
    const Crossings& operands_;
    std::span<const Source* const> sources_;
    BoundaryParts& parts_;
    std::uint32_t threads_;
    const OperandTable operand_of_;
    PoolVector<PlaneId> planes_;  // by facet: the first one, where it is in use
    Workbench::Room room_;
    FacetMarks* marks_ = nullptr;  // of the last slot
    std::size_t marked_slot_ = ~std::size_t{0};
};

}  // namespace

void add_outlined(const OutlinedFacets& outlined, const Crossings& operands,
                  std::span<const Source* const> sources, BoundaryParts& parts,
                  BoundaryEdges& edges, std::uint32_t threads) {
    check_stop(outlined.edges.size());
    if (operands.special.empty())
        return OutlinedByNumber(outlined, operands, sources, parts, threads).add(edges);
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
