// SPDX-License-Identifier: Apache-2.0
//
// Two boundaries in general position cross in closed polylines. On each facet they leave paths of
// segments, from one point of its outline to another or closed, and these are where the result's
// part of the facet ends: there the winding number of the other operand changes. So the outline of
// that part is known without any cutting: the segments, each with the part on its left, and what
// lies between them of the facet's own edges. A segment that ends in an edge lets the part go on
// from there counter-clockwise, up to where the next segment starts.
//
// What leaves have made of the same facet is convex pieces, cut by the walls of cells and by the
// lines of segments far beyond their ends. To join those takes several times as long, and comes to
// the same: every vertex of either is where an edge pierces a facet, or a corner.
//
// A facet with nothing but closed paths is left to the pieces, as is one whose segments do not make
// closed outlines by name.

#include <trisect/bsp/detail/traced_facets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace trisect::detail {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

class Tracer {
public:
    Tracer(const Crossings& crossings, BoundaryParts& parts, std::vector<BoundaryEdge>& edges)
        : crossings_(crossings), parts_(parts), edges_(edges) {}

    void run() {
        for (std::size_t side = 0; side < 2; ++side) {
            const auto t =
                std::ranges::find(parts_.sources, crossings_.operands[side].serial,
                                  [](const FacetMarks& marks) { return marks.source()->serial(); });
            if (t == parts_.sources.end()) return;  // nothing of it is left
            marks_[side] = &*t;
        }
        ends_.assign(crossings_.pairs.size(), {-1, -1});
        edges_of_.assign(crossings_.pairs.size(), {-1, -1});
        for (std::size_t side = 0; side < 2; ++side) {
            order_[side].resize(crossings_.pairs.size());
            std::iota(order_[side].begin(), order_[side].end(), 0U);
            if (side == 1)
                std::ranges::sort(order_[side], {}, [&](std::uint32_t i) {
                    return std::pair(crossings_.pairs[i].facets[1], i);
                });
            name_planes(side);
        }
        for (std::size_t side = 0; side < 2; ++side) trace_all(side);
    }

private:
    // Where a segment ends in an edge of the facet.
    struct EdgePoint {
        PointId point = -1;
        std::int8_t edge = 0;
        bool opens = false;  // the result's part goes on from here along the edge
    };

    // Looked up once for each facet.
    void name_planes(std::size_t side) {
        const Source* const source = marks_[side]->source();
        std::uint32_t last = 0;
        PlaneId edge = -1;
        for (const std::uint32_t i : order_[side]) {
            const std::uint32_t facet = crossings_.pairs[i].facets[side];
            if (edge < 0 || facet != last)
                edge = parts_.bench.plane(PlaneName::edge(source, facet, 0));
            last = facet;
            edges_of_[i][side] = edge;
        }
    }

    void trace_all(std::size_t side) {
        const Crossings::Operand& operand = crossings_.operands[side];
        const auto& doubtful = crossings_.doubtful[side];
        const auto& order = order_[side];
        for (std::size_t i = 0; i < order.size();) {
            const std::uint32_t facet = crossings_.pairs[order[i]].facets[side];
            std::size_t j = i + 1;
            while (j < order.size() && crossings_.pairs[order[j]].facets[side] == facet) ++j;
            const auto pairs = std::span(order).subspan(i, j - i);
            i = j;
            if (!marks_[side]->takes_part(facet, operand.inside_above) ||
                marks_[side]->is_worked(facet, !operand.inside_above) ||
                std::ranges::binary_search(doubtful, facet))
                continue;
            const std::size_t first = edges_.size();
            if (trace(side, facet, pairs)) {
                marks_[side]->set_traced(facet);
                ++parts_.stats.traced_facets;
            } else {
                edges_.resize(first);
            }
        }
    }

    bool trace(std::size_t side, std::uint32_t facet, std::span<const std::uint32_t> pairs) {
        const Crossings::Operand& operand = crossings_.operands[side];
        const Source* const source = marks_[side]->source();
        const PlaneId own = edges_of_[pairs[0]][side];
        const std::int32_t number = marks_[side]->number_of_worked(facet, operand.inside_above);
        const std::size_t first = edges_.size();
        on_edges_.clear();
        // Within the facet, to the left of the product of the normals, is what lies below the other
        // facet for the first one, and above it for the second one.
        const bool keep_below = (operand.keep == 1) != crossings_.operands[1 - side].flipped;
        const bool along = keep_below == (side == 0);
        for (const std::uint32_t i : pairs) {
            const FacetCrossing& c = crossings_.pairs[i];
            const auto& points = ends_of(i);
            const PlaneId other = parts_.bench.support_of(edges_of_[i][1 - side]);
            for (std::size_t end = 0; end < 2; ++end)
                if (c.ends[end].of_second == (side == 1))
                    on_edges_.push_back({points[end], c.ends[end].edge, (end == 1) == along});
            edges_.push_back(
                {points[along ? 0 : 1], points[along ? 1 : 0], number, {other, !keep_below}});
        }
        if (on_edges_.empty() || !sort_along(*source, facet)) return false;
        if (!add_between(*source, facet, own, number)) return false;
        const std::span<BoundaryEdge> made = std::span(edges_).subspan(first);
        if (!is_closed(made)) return false;
        if (operand.inside_above) {
            std::ranges::reverse(made);
            for (BoundaryEdge& e : made) std::swap(e.from, e.to);
        }
        BoundaryFacet& f = parts_.facets[u(number)];
        f.support = parts_.bench.support_of(own);
        f.parts = 1;
        return true;
    }

    const std::array<PointId, 2>& ends_of(std::uint32_t pair) {
        auto& ends = ends_[pair];
        if (ends[0] >= 0) return ends;
        const FacetCrossing& c = crossings_.pairs[pair];
        for (std::size_t k = 0; k < 2; ++k) {
            const std::size_t side = c.ends[k].of_second ? 1 : 0;
            const Source* const source = marks_[side]->source();
            const PolygonRef ref{source, nullptr, c.facets[side], false, false};
            Workbench& bench = parts_.bench;
            const PlaneId first = edges_of_[pair][side];
            ends[k] = bench.vertex(ref, bench.support_of(first), first + c.ends[k].edge,
                                   bench.support_of(edges_of_[pair][1 - side]), c.ends[k].at);
        }
        return ends;
    }

    // In the order of a walk around the facet. False when two points cannot be told apart.
    bool sort_along(const Source& source, std::uint32_t facet) {
        bool distinct = true;
        std::ranges::sort(on_edges_, [&](const EdgePoint& a, const EdgePoint& b) {
            if (a.edge != b.edge) return a.edge < b.edge;
            if (a.point == b.point) return false;
            const LatticePoint& from = source.corner(facet, a.edge);
            const LatticePoint& to = source.corner(facet, (a.edge + 1) % 3);
            const std::array<std::int64_t, 3> way{to.x - from.x, to.y - from.y, to.z - from.z};
            int axis = 0;
            for (int k = 1; k < 3; ++k)
                if (std::abs(way[u(k)]) > std::abs(way[u(axis)])) axis = k;
            const int order = compare_along(parts_.bench, a.point, b.point, axis);
            distinct = distinct && order != 0;
            return order == (way[u(axis)] > 0 ? -1 : 1);
        });
        return distinct &&
               std::ranges::adjacent_find(on_edges_, {}, &EdgePoint::point) == on_edges_.end();
    }

    // What the part has of the facet's own edges.
    bool add_between(const Source& source, std::uint32_t facet, PlaneId own, std::int32_t number) {
        const std::size_t n = on_edges_.size();
        for (std::size_t i = 0; i < n; ++i) {
            const EdgePoint& from = on_edges_[i];
            const EdgePoint& to = on_edges_[i + 1 < n ? i + 1 : 0];
            if (from.opens == to.opens) return false;
            if (!from.opens) continue;
            const auto add = [&](PointId a, PointId b, int edge) {
                edges_.push_back({a, b, number, {own + edge, false}});
            };
            PointId at = from.point;
            int edge = from.edge;
            // The last one of them may open a part that runs around all corners.
            for (bool around = i + 1 == n; edge != to.edge || around; edge = (edge + 1) % 3) {
                const PointId corner = parts_.bench.corner(&source, facet, (edge + 1) % 3);
                add(at, corner, edge);
                at = corner;
                around = false;
            }
            add(at, to.point, edge);
        }
        return true;
    }

    // Whether as many edges end in every vertex as begin there.
    bool is_closed(std::span<const BoundaryEdge> made) {
        from_.clear();
        to_.clear();
        for (const BoundaryEdge& e : made) {
            from_.push_back(e.from);
            to_.push_back(e.to);
        }
        std::ranges::sort(from_);
        std::ranges::sort(to_);
        return from_ == to_;
    }

    const Crossings& crossings_;
    BoundaryParts& parts_;
    std::vector<BoundaryEdge>& edges_;
    std::array<FacetMarks*, 2> marks_{};
    std::vector<std::array<PointId, 2>> ends_;  // of the pairs, where they were asked for
    // Of the pairs and by operand: the first edge plane of the facet.
    std::vector<std::array<PlaneId, 2>> edges_of_;
    std::array<std::vector<std::uint32_t>, 2> order_;  // the pairs, by facet
    std::vector<EdgePoint> on_edges_;                  // of one facet
    std::vector<PointId> from_;
    std::vector<PointId> to_;
};

}  // namespace

void trace_facets(const Crossings& crossings, BoundaryParts& parts,
                  std::vector<BoundaryEdge>& edges) {
    Tracer(crossings, parts, edges).run();
}

}  // namespace trisect::detail
