// SPDX-License-Identifier: Apache-2.0
//
// Two boundaries in general position cross in closed polylines. On each facet they leave paths of
// segments, and these are where the result's part of the facet ends (facet_outline.cpp). So the
// outline of that part is known without any cutting, however many operands cross the facet.
//
// What leaves have made of the same facet is convex pieces, cut by the bounding planes of cells and
// by the lines of segments far beyond their ends. To join those takes several times as long, and
// comes to the same: every vertex of either is where an edge pierces a facet, where three facets
// meet, or a corner.
//
// A facet of which doubles cannot decide the outline is left to the pieces, but of two meshes in
// special position there are none (assembly_parts.cpp): so nothing else needs their planes and
// corners, which get their numbers by the numbers of facets and corners and not by their names.

#include <trisect/bsp/assembly/traced/traced_facets.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/assembly/traced/facet_tracing.h>
#include <trisect/bsp/assembly/traced/operand_table.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/ordered_parts.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Fewer are not worth a part.
constexpr std::size_t least_facets = 256;

// Names what is traced. Names belong to one thread, and are given in the order of the facets.
class Tracer {
public:
    Tracer(const Crossings& crossings, BoundaryParts& parts, BoundaryEdges& edges)
        : crossings_(crossings),
          operand_of_(crossings.operands),
          parts_(parts),
          edges_(edges),
          by_number_(!crossings.special.empty() && !crossings.has_other_sides) {}

    void run(std::uint32_t threads) {
        find_marks();
        ends_.assign(crossings_.pairs.size(), {-1, -1});
        edges_of_.assign(crossings_.pairs.size(), {-1, -1});
        planes_.assign(by_number_ ? facet_count() : parts_.facets.size(), -1);
        if (by_number_) corner_ids_.resize(marks_.size());
        // Of the loops of a facet one edge for each segment, and about as many along its own edges.
        edges_.reserve(edges_.size() + 4 * crossings_.pairs.size() + 3 * crossings_.shown.size());
        const ParallelParts parts(crossings_.shown.size(), threads, least_facets);
        if (parts.count() == 1) {
            FacetTracing(crossings_, operand_of_, marks_)
                .run(0, crossings_.shown.size(), [&](const TracedFacet& f) { add(f); });
        } else {
            trace_in_parts(parts.count(), threads);
        }
        for (const std::uint32_t facet : crossings_.special)
            if (!std::ranges::binary_search(crossings_.shown, facet)) add_whole(facet);
    }

private:
    // Some threads trace while this one gives names.
    void trace_in_parts(std::size_t count, std::uint32_t threads) {
        std::vector<TracedFacets> traced(count);
        const auto trace = [&](std::size_t part) {
            FacetTracing(crossings_, operand_of_, marks_)
                .run(begin_of(part, count), begin_of(part + 1, count),
                     [&](const TracedFacet& f) { traced[part].add(f); });
        };
        const auto name = [&](std::size_t part) {
            traced[part].for_each([&](const TracedFacet& f) { add(f); });
            traced[part] = {};
        };
        for_each_in_order(count, threads, trace, name);
    }

    // The first facet of a part: parts have as many facets and segments as others, since one facet
    // may have nearly all segments.
    [[nodiscard]] std::size_t begin_of(std::size_t part, std::size_t count) const {
        const auto& shown = crossings_.shown;
        const std::size_t all = shown.size() + 2 * crossings_.pairs.size();
        const std::size_t before = all * part / count;
        const auto is_before = [&](const std::uint32_t& number) {
            return static_cast<std::size_t>(&number - shown.data()) +
                       FacetTracing::segments_before(crossings_, number) <
                   before;
        };
        const auto at = std::partition_point(shown.begin(), shown.end(), is_before);
        return static_cast<std::size_t>(at - shown.begin());
    }

    // Nothing is left of a source without marks.
    void find_marks() {
        for (const Crossings::Operand& o : crossings_.operands) {
            const auto at =
                std::ranges::lower_bound(parts_.sources, o.serial, {},
                                         [](const FacetMarks& m) { return m.source()->serial(); });
            const bool found = at != parts_.sources.end() && at->source()->serial() == o.serial;
            marks_.push_back(found ? &*at : nullptr);
        }
    }

    // All that are numbered, but for those of a last operand of which nothing is left.
    [[nodiscard]] std::size_t facet_count() const {
        const FacetMarks* const last = marks_.back();
        return crossings_.operands.back().first +
               (last == nullptr ? 0 : last->source()->facet_count());
    }

    PointId corner(std::size_t operand, std::uint32_t facet, int i) {
        const Source* const source = marks_[operand]->source();
        if (!by_number_) return parts_.bench.corner(source, facet, i);
        PoolVector<PointId>& known = corner_ids_[operand];
        if (known.empty()) known.resize(source->mesh().points.size(), -1);
        const std::uint32_t vertex = source->corner_index(facet, i);
        if (known[vertex] < 0) known[vertex] = parts_.bench.add_corner(source, vertex);
        return known[vertex];
    }

    void add(const TracedFacet& traced) {
        traced_ = traced;
        const std::size_t operand = operand_of_(traced.number);
        const Crossings::Operand& o = crossings_.operands[operand];
        FacetMarks* const marks = marks_[operand];
        const std::uint32_t facet = traced.number - o.first;
        add_edges(operand, facet, o.inside_above);
        marks->set_traced(facet, o.inside_above);
        ++parts_.stats.traced_facets;
    }

    // A facet that something touches and nothing crosses.
    void add_whole(std::uint32_t number) {
        const std::size_t operand = crossings_.operand_of(number);
        const Crossings::Operand& o = crossings_.operands[operand];
        FacetMarks* const marks = marks_[operand];
        const std::uint32_t facet = number - o.first;
        if (marks == nullptr || !marks->takes_part(facet, o.inside_above)) return;
        const std::int32_t worked = marks->number_of_worked(facet, o.inside_above);
        const PlaneId edge = first_edge_of(operand, facet);
        BoundaryFacet& f = parts_.facets[as_index(worked)];
        f.support = parts_.bench.support_of(edge);
        f.parts = 2;
        f.is_special = true;
        std::array<PointId, 3> points{};
        for (int i = 0; i < 3; ++i) points[as_index(i)] = corner(operand, facet, i);
        for (int k = 0; k < 3; ++k) {
            const int i = o.inside_above ? 2 - k : k;
            PointId from = points[as_index(i)];
            PointId to = points[as_index((i + 1) % 3)];
            if (o.inside_above) std::swap(from, to);
            edges_.push_back({from, to, worked, {edge + i, false}});
        }
        marks->set_traced(facet, o.inside_above);
        ++parts_.stats.traced_facets;
    }

    void add_edges(std::size_t operand, std::uint32_t facet, bool flipped) {
        if (traced_.edges.empty()) return;
        const FacetMarks& marks = *marks_[operand];
        operand_ = operand;
        ref_ = {marks.source(), nullptr, facet, false, false};
        own_ = edge_of(traced_.segments[0].pair, traced_.segments[0].side);
        own_support_ = support_of(traced_.segments[0].pair, traced_.segments[0].side);
        corners_ = {-1, -1, -1};
        meetings_.assign(traced_.meetings.size(), -1);
        const std::int32_t number = marks.number_of_worked(facet, flipped);
        for (const TracedEdge& e : traced_.edges) {
            PointId from = point_of(e.from);
            PointId to = point_of(e.to);
            if (flipped) std::swap(from, to);
            edges_.push_back({from, to, number, line_of(e)});
        }
        if (flipped) {
            const auto n = static_cast<std::ptrdiff_t>(traced_.edges.size());
            std::reverse(edges_.end() - n, edges_.end());
        }
        BoundaryFacet& f = parts_.facets[as_index(number)];
        f.support = own_support_;
        f.is_special = traced_.is_special;
        f.is_general = !f.is_special && own_support_ == own_ + 3;
        f.parts = f.is_special ? 2 : 1;
    }

    WorkEdge line_of(const TracedEdge& e) {
        if (e.edge >= 0) return {own_ + e.edge, false};
        return {support_of_cutter(e.segment), !traced_.segments[e.segment].open_below};
    }

    PointId point_of(const OutlinePoint& p) {
        switch (p.kind) {
            case OutlinePoint::Kind::Corner: {
                PointId& point = corners_[static_cast<std::size_t>(p.which)];
                if (point < 0) point = corner(operand_, ref_.facet, p.which);
                return point;
            }
            case OutlinePoint::Kind::End:
                return end_of(p.place, as_index(p.which));
            case OutlinePoint::Kind::Meeting:
                break;
        }
        PointId& point = meetings_[p.place];
        if (point < 0) point = meeting(traced_.meetings[p.place]);
        return point;
    }

    PointId meeting(const OutlineMeetings::Point& p) {
        return parts_.bench.vertex(ref_, own_support_, support_of_cutter(p.segments[0]),
                                   support_of_cutter(p.segments[1]), p.at);
    }

    PlaneId support_of_cutter(std::uint32_t segment) {
        const TracedSegment& s = traced_.segments[segment];
        return support_of(s.pair, 1 - s.side);
    }

    // Where one segment ends and the next one begins the same edge pierces the facet.
    PointId end_of(std::uint32_t segment, std::size_t end) {
        PointId& point = known_end(segment, end);
        if (point < 0) point = name_end(traced_.segments[segment].pair, end_in_pair(segment, end));
        const std::uint32_t next = traced_.segments[segment].next;
        if (end == 1 && next != FacetOutline::none) known_end(next, 0) = point;
        return point;
    }

    // Ends of segments come in the order of their direction.
    [[nodiscard]] std::size_t end_in_pair(std::uint32_t segment, std::size_t end) const {
        const TracedSegment& s = traced_.segments[segment];
        const bool along = s.open_below == (s.side == 0);
        return along ? end : 1 - end;
    }

    PointId& known_end(std::uint32_t segment, std::size_t end) {
        return ends_[traced_.segments[segment].pair][end_in_pair(segment, end)];
    }

    PointId name_end(std::uint32_t pair, std::size_t k) {
        const FacetCrossing& c = crossings_.pairs[pair];
        const std::size_t side = c.ends[k].of_second ? 1 : 0;
        const std::size_t operand = operand_of_(c.facets[side]);
        const std::uint32_t facet = c.facets[side] - crossings_.operands[operand].first;
        if (c.ends[k].corner >= 0) return corner(operand, facet, c.ends[k].corner);
        const PolygonRef ref{marks_[operand]->source(), nullptr, facet, false, false};
        Workbench& bench = parts_.bench;
        const PlaneId first = edge_of(pair, side);
        return bench.vertex(ref, bench.support_of(first), first + c.ends[k].edge,
                            support_of(pair, 1 - side), c.ends[k].at);
    }

    PlaneId support_of(std::uint32_t pair, std::size_t side) {
        const PlaneId first = edge_of(pair, side);
        const PlaneId support = parts_.bench.support_of(first);
        return support >= 0 ? support : first;
    }

    // The plane of the first edge of one of a pair's facets; that of a half-space has its support
    // only.
    PlaneId edge_of(std::uint32_t pair, std::size_t side) {
        PlaneId& plane = edges_of_[pair][side];
        if (plane >= 0) return plane;
        const std::uint32_t number = crossings_.pairs[pair].facets[side];
        const std::size_t operand = operand_of_(number);
        return plane = first_edge_of(operand, number - crossings_.operands[operand].first);
    }

    PlaneId first_edge_of(std::size_t operand, std::uint32_t facet) {
        const Crossings::Operand& o = crossings_.operands[operand];
        const FacetMarks& marks = *marks_[operand];
        if (by_number_) {
            PlaneId& known = planes_[o.first + facet];
            if (known < 0) known = parts_.bench.add_facet(marks.source(), facet);
            return known;
        }
        PlaneId unnumbered = -1;
        PlaneId& known = marks.takes_part(facet, o.inside_above)
                             ? planes_[as_index(marks.number_of_worked(facet, o.inside_above))]
                             : unnumbered;
        if (known < 0)
            known = parts_.bench.plane(marks.source()->is_half_space()
                                           ? PlaneName::support(marks.source(), facet)
                                           : PlaneName::edge(marks.source(), facet, 0));
        return known;
    }

    const Crossings& crossings_;
    const OperandTable operand_of_;
    BoundaryParts& parts_;
    BoundaryEdges& edges_;
    std::vector<FacetMarks*> marks_;               // by operand
    PoolVector<std::array<PointId, 2>> ends_;      // of the pairs, where they were requested
    PoolVector<std::array<PlaneId, 2>> edges_of_;  // of their facets, likewise
    const bool by_number_;
    PoolVector<PlaneId> planes_;  // the same by number of the facet: of the crossings where
                                  // by_number_, else of those that are worked on
    std::vector<PoolVector<PointId>> corner_ids_;  // by operand and vertex, where by_number_
    // Of one facet:
    TracedFacet traced_;
    std::size_t operand_ = 0;
    std::array<PointId, 3> corners_{};  // where they were requested
    PoolVector<PointId> meetings_;      // of the outline, likewise
    PolygonRef ref_;
    PlaneId own_ = -1;  // of its first edge
    PlaneId own_support_ = -1;
};

}  // namespace

void trace_facets(const Crossings& crossings, BoundaryParts& parts, BoundaryEdges& edges,
                  std::uint32_t threads) {
    Tracer(crossings, parts, edges).run(threads);
}

}  // namespace trisect::detail
