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
// A facet of which doubles cannot decide the outline is left to the pieces.

#include <trisect/bsp/assembly/traced/traced_facets.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/assembly/traced/facet_outline.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Which operand a facet belongs to, of many: by a table of about twice as many equal ranges of
// facets as there are operands, most of which are in one or two.
class OperandTable {
public:
    explicit OperandTable(const std::vector<Crossings::Operand>& operands) : operands_(operands) {
        const std::uint64_t end = operands.back().first;
        while (end >> shift_ > 2 * operands.size()) ++shift_;
        std::uint32_t at = 0;
        for (std::uint64_t number = 0; number <= end; number += std::uint64_t{1} << shift_) {
            while (at + 1 < operands.size() && operands[at + 1].first <= number) ++at;
            ranges_.push_back(at);
        }
        ranges_.push_back(static_cast<std::uint32_t>(operands.size() - 1));
    }
    [[nodiscard]] std::size_t operator()(std::uint32_t number) const {
        const std::size_t range = std::min(std::size_t{number >> shift_}, ranges_.size() - 2);
        const auto first = operands_.begin() + ranges_[range];
        const auto last = operands_.begin() + ranges_[range + 1] + 1;
        const auto next =
            std::ranges::upper_bound(first, last, number, {}, &Crossings::Operand::first);
        return static_cast<std::size_t>(next - operands_.begin()) - 1;
    }

private:
    const std::vector<Crossings::Operand>& operands_;
    std::vector<std::uint32_t> ranges_;  // the operand of the first facet of each; then the last
    unsigned shift_ = 0;
};

class Tracer {
public:
    Tracer(const Crossings& crossings, BoundaryParts& parts, std::vector<BoundaryEdge>& edges)
        : crossings_(crossings), operand_of_(crossings.operands), parts_(parts), edges_(edges) {}

    void run() {
        find_marks();
        ends_.assign(crossings_.pairs.size(), {-1, -1});
        edges_of_.assign(crossings_.pairs.size(), {-1, -1});
        planes_.assign(parts_.facets.size(), -1);
        const auto& pairs = crossings_.pairs;
        const auto& by_second = crossings_.by_second;
        std::size_t first = 0;
        std::size_t second = 0;
        auto uncertain = crossings_.uncertain.begin();
        for (const std::uint32_t facet : crossings_.shown) {
            while (first < pairs.size() && pairs[first].facets[0] < facet) ++first;
            while (second < pairs.size() && pairs[by_second[second]].facets[1] < facet) ++second;
            sides_.clear();
            for (; first < pairs.size() && pairs[first].facets[0] == facet; ++first)
                sides_.push_back({static_cast<std::uint32_t>(first), 0});
            for (; second < pairs.size() && pairs[by_second[second]].facets[1] == facet; ++second)
                sides_.push_back({by_second[second], 1});
            while (uncertain != crossings_.uncertain.end() && *uncertain < facet) ++uncertain;
            if (uncertain == crossings_.uncertain.end() || *uncertain != facet) look_at(facet);
        }
    }

private:
    // A pair, and which of its facets is looked at.
    struct Side {
        std::uint32_t pair = 0;
        std::uint32_t side = 0;
    };

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

    void look_at(std::uint32_t number) {
        const std::size_t operand = operand_of_(number);
        const Crossings::Operand& o = crossings_.operands[operand];
        FacetMarks* const marks = marks_[operand];
        const std::uint32_t facet = number - o.first;
        if (marks == nullptr || !marks->takes_part(facet, o.inside_above) ||
            marks->is_worked(facet, !o.inside_above))
            return;
        const Source* const source = marks->source();
        if (!list_segments() || !trace(*source, facet)) return;
        add_edges(*marks, facet, o.inside_above);
        marks->set_traced(facet);
        ++parts_.stats.traced_facets;
    }

    // Of a half-space the facet is the whole plane.
    bool trace(const Source& source, std::uint32_t facet) {
        return source.is_half_space() ? outline_.trace_section(source.support(facet), segments_)
                                      : outline_.trace(corners_of(source, facet), segments_);
    }

    static std::array<const LatticePoint*, 3> corners_of(const Source& source,
                                                         std::uint32_t facet) {
        return {&source.corner(facet, 0), &source.corner(facet, 1), &source.corner(facet, 2)};
    }

    // False when nothing is left of an operand that crosses the facet. Those that come first in
    // pairs are in the order of their numbers, and so are those that come second; the facet's own
    // operand is between them, so each operand comes once.
    bool list_segments() {
        segments_.resize(sides_.size());
        std::size_t n = 0;
        std::uint32_t cutters = 0;
        std::uint32_t begin = 0;  // of the facets of the last one
        std::uint32_t end = 0;
        const Crossings::Operand* operand = nullptr;
        const Source* source = nullptr;
        for (const Side& s : sides_) {
            const FacetCrossing& c = crossings_.pairs[s.pair];
            const std::uint32_t number = c.facets[1 - s.side];
            if (number < begin || number >= end) {
                const std::size_t i = operand_of_(number);
                if (marks_[i] == nullptr) return false;
                operand = &crossings_.operands[i];
                source = marks_[i]->source();
                begin = operand->first;
                end = begin + source->facet_count();
                ++cutters;
            }
            OutlineSegment& segment = segments_[n++];
            segment.cutter = cutters - 1;
            segment.open_below = operand->is_open_below();
            set_ends(c, s.side, *source, number - begin, segment);
        }
        return true;
    }

    static void set_ends(const FacetCrossing& c, std::uint32_t side, const Source& source,
                         std::uint32_t facet, OutlineSegment& segment) {
        // Within the facet, to the left of the product of the normals, is what lies below the
        // other facet for the first one, and above it for the second one.
        const bool along = segment.open_below == (side == 0);
        for (std::size_t k = 0; k < 2; ++k) {
            const FacetCrossing::End& end = c.ends[along ? k : 1 - k];
            segment.at[k] = &end.at;
            const bool is_own = end.of_second == (side == 1);
            segment.edge[k] = static_cast<std::int8_t>(is_own ? end.edge : -1);
            if (is_own) continue;
            const std::uint64_t v = source.corner_index(facet, end.edge);
            const std::uint64_t w = source.corner_index(facet, end.edge == 2 ? 0 : end.edge + 1);
            segment.through[k] = std::min(v, w) << 32 | std::max(v, w);
        }
    }

    void add_edges(FacetMarks& marks, std::uint32_t facet, bool flipped) {
        if (outline_.edges().empty()) return;
        ref_ = {marks.source(), nullptr, facet, false, false};
        own_ = edge_of(sides_[0].pair, sides_[0].side);
        own_support_ = support_of(sides_[0].pair, sides_[0].side);
        corners_ = {-1, -1, -1};
        meetings_.assign(outline_.meetings().size(), -1);
        const std::int32_t number = marks.number_of_worked(facet, flipped);
        for (const TracedEdge& e : outline_.edges()) {
            PointId from = point_of(e.from);
            PointId to = point_of(e.to);
            if (flipped) std::swap(from, to);
            edges_.push_back({from, to, number, line_of(e)});
        }
        if (flipped) {
            const auto n = static_cast<std::ptrdiff_t>(outline_.edges().size());
            std::reverse(edges_.end() - n, edges_.end());
        }
        BoundaryFacet& f = parts_.facets[as_index(number)];
        f.support = own_support_;
        f.parts = 1;
    }

    WorkEdge line_of(const TracedEdge& e) {
        if (e.edge >= 0) return {own_ + e.edge, false};
        return {support_of_cutter(e.segment), !segments_[e.segment].open_below};
    }

    PointId point_of(const OutlinePoint& p) {
        switch (p.kind) {
            case OutlinePoint::Kind::Corner: {
                PointId& point = corners_[static_cast<std::size_t>(p.which)];
                if (point < 0) point = parts_.bench.corner(ref_.source, ref_.facet, p.which);
                return point;
            }
            case OutlinePoint::Kind::End:
                return end_of(p.place, as_index(p.which));
            case OutlinePoint::Kind::Meeting:
                break;
        }
        PointId& point = meetings_[p.place];
        if (point < 0) point = meeting(outline_.meetings()[p.place]);
        return point;
    }

    PointId meeting(const OutlineMeetings::Point& p) {
        return parts_.bench.vertex(ref_, own_support_, support_of_cutter(p.segments[0]),
                                   support_of_cutter(p.segments[1]), p.at);
    }

    PlaneId support_of_cutter(std::uint32_t segment) {
        const Side& s = sides_[segment];
        return support_of(s.pair, 1 - s.side);
    }

    // Where one segment ends and the next one begins the same edge pierces the facet.
    PointId end_of(std::uint32_t segment, std::size_t end) {
        PointId& point = known_end(segment, end);
        if (point < 0) point = name_end(sides_[segment].pair, end_in_pair(segment, end));
        if (end == 1 && outline_.next(segment) != FacetOutline::none)
            known_end(outline_.next(segment), 0) = point;
        return point;
    }

    // Ends of segments come in the order of their direction.
    [[nodiscard]] std::size_t end_in_pair(std::uint32_t segment, std::size_t end) const {
        const bool along = segments_[segment].open_below == (sides_[segment].side == 0);
        return along ? end : 1 - end;
    }

    PointId& known_end(std::uint32_t segment, std::size_t end) {
        return ends_[sides_[segment].pair][end_in_pair(segment, end)];
    }

    PointId name_end(std::uint32_t pair, std::size_t k) {
        const FacetCrossing& c = crossings_.pairs[pair];
        const std::size_t side = c.ends[k].of_second ? 1 : 0;
        const std::size_t operand = operand_of_(c.facets[side]);
        const PolygonRef ref{marks_[operand]->source(), nullptr,
                             c.facets[side] - crossings_.operands[operand].first, false, false};
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
        const Crossings::Operand& o = crossings_.operands[operand];
        const FacetMarks& marks = *marks_[operand];
        const std::uint32_t facet = number - o.first;
        PlaneId none = -1;
        PlaneId& known = marks.takes_part(facet, o.inside_above)
                             ? planes_[as_index(marks.number_of_worked(facet, o.inside_above))]
                             : none;
        if (known < 0)
            known = parts_.bench.plane(marks.source()->is_half_space()
                                           ? PlaneName::support(marks.source(), facet)
                                           : PlaneName::edge(marks.source(), facet, 0));
        return plane = known;
    }

    const Crossings& crossings_;
    const OperandTable operand_of_;
    BoundaryParts& parts_;
    std::vector<BoundaryEdge>& edges_;
    std::vector<FacetMarks*> marks_;                // by operand
    std::vector<std::array<PointId, 2>> ends_;      // of the pairs, where they were requested
    std::vector<std::array<PlaneId, 2>> edges_of_;  // of their facets, likewise
    std::vector<PlaneId> planes_;                   // the same by number of the facet
    // Of one facet:
    std::vector<Side> sides_;
    std::vector<OutlineSegment> segments_;
    FacetOutline outline_;
    std::array<PointId, 3> corners_{};  // where they were requested
    std::vector<PointId> meetings_;     // of the outline, likewise
    PolygonRef ref_;
    PlaneId own_ = -1;  // of its first edge
    PlaneId own_support_ = -1;
};

}  // namespace

void trace_facets(const Crossings& crossings, BoundaryParts& parts,
                  std::vector<BoundaryEdge>& edges) {
    Tracer(crossings, parts, edges).run();
}

}  // namespace trisect::detail
