// SPDX-License-Identifier: Apache-2.0
//
// A trace costs as much as all other work on a piece, and neighbours nearly always have the same
// answer. Walking from one to the next over their common edge is a trace of length zero: the only
// surfaces that it can cross are those that contain the part of the edge where it is done, and
// contacts determine these. So the signs here are local, and a leaf with one connected surface of
// each of two operands needs no trace at all where the surfaces cross, and one a surface where they
// do not.
//
// EMBER (Trettner, Nehring-Wirxel, Kobbelt 2022, sec. 5.4) propagates winding numbers along walks
// through the local BSP; here only certain neighbours count, the others get a trace.

#include <trisect/bsp/leaf/exact/leaf_links.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

bool is_own_edge(const PolygonRef& ref, const PlaneName& plane) {
    return plane.is_edge() && plane.source() == ref.source && plane.facet == ref.facet;
}

bool is_splitter_of(const Cell& cell, const PlaneName& plane) {
    if (!plane.is_splitter()) return false;
    return plane.position() == cell.lo[plane.facet] || plane.position() == cell.hi[plane.facet];
}

// Whether some point of the segment is in the open cell for certain: a candidate is found without
// care and then checked with a margin.
bool certainly_enters(const Cell& cell, const Approximation& p, const Approximation& q) {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    double from = 0x1p-6;  // away from the ends, which are known up to their errors only
    double to = 1 - 0x1p-6;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = rounded_position(cell.lo[k]);
        hi[k] = rounded_position(cell.hi[k]);
        largest = std::max({largest, std::fabs(p.c[k]), std::fabs(q.c[k])});
        const double d = q.c[k] - p.c[k];
        if (d == 0) continue;
        const double s = (lo[k] - p.c[k]) / d;
        const double t = (hi[k] - p.c[k]) / d;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    if (!(from < to)) return false;
    const double middle = 0.5 * (from + to);
    // The candidate is within three roundings and the errors of the ends of a point of the segment;
    // splitting planes carry one rounding, at most that of the candidate's size where they are near
    // it.
    const double margin = bound_slack * (p.error + q.error) + 0x1p-48 * largest;
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = p.c[k] + middle * (q.c[k] - p.c[k]);
        if (!(lo[k] + margin < x && x < hi[k] - margin)) return false;
    }
    return true;
}

}  // namespace

void LeafLinks::build(LeafWork& work) {
    work_ = &work;
    items_ = work.item_count();
    const std::size_t nodes = work.items.size() + work.pieces.size();
    parent_.resize(nodes);
    for (std::size_t i = 0; i < nodes; ++i) parent_[i] = static_cast<LeafNode>(i);
    first_link_.assign(nodes, -1);
    first_known_.assign(nodes, -1);
    links_.clear();
    changes_.clear();
    known_.clear();
    line_ids_.clear();
    lines_.clear();
    edges_.clear();
    for (LeafIndex i = 0; i < items_; ++i)
        if (work.item(i).is_whole()) add_node(i);
    for (std::size_t p = 0; p < work.pieces.size(); ++p)
        if (!work.pieces[p].dropped) add_node(items_ + static_cast<LeafIndex>(p));
    // Those that others represent are no nodes, but at their edges there are more than two facets.
    for (const LeafPiece& piece : work.pieces)
        if (piece.dropped && !work.operand_of(work.item(piece.item)).embedded)
            count_at_edges(piece);
    // Lines within facets first: they give winding numbers, and a pair that is linked already is
    // not looked at again.
    for (const Line& line : lines_)
        if (line.within_facet) link_line(line);
    for (const Line& line : lines_)
        if (!line.within_facet) link_line(line);
}

LeafNode LeafLinks::tree_of(LeafNode node) {
    while (parent_[as_index(node)] != node)
        node = parent_[as_index(node)] = parent_[as_index(parent_[as_index(node)])];
    return node;
}

LeafIndex LeafLinks::item_index(LeafNode node) const {
    return node < items_ ? node : work_->pieces[as_index(node - items_)].item;
}

const LeafItem& LeafLinks::item_of(LeafNode node) const { return work_->item(item_index(node)); }

const WorkPolygon& LeafLinks::shape_of(LeafNode node) {
    return node < items_ ? work_->shape(node) : work_->pieces[as_index(node - items_)].shape;
}

void LeafLinks::add_node(LeafNode node) {
    const PolygonRef& ref = item_of(node).ref;
    if (node >= items_) {
        const auto& edges = work_->pieces[as_index(node - items_)].shape.edges;
        for (std::size_t k = 0; k < edges.size(); ++k)
            add_edge(node, static_cast<int>(k), work_->bench.name(edges[k].plane));
    } else if (ref.fragment != nullptr) {
        const auto edges = ref.fragment->edges();
        for (std::size_t k = 0; k < edges.size(); ++k)
            add_edge(node, static_cast<int>(k), edges[k].plane);
    } else if (!ref.source->is_half_space()) {
        for (int k = 0; k < 3; ++k) add_edge(node, k, PlaneName::edge(ref.source, ref.facet, k));
    }
}

Key128 LeafLinks::key_of_edge(const LeafItem& item, const PlaneName& edge) {
    const auto v = edge.source()->corner_index(edge.facet, static_cast<int>(edge.kind));
    const auto w = edge.source()->corner_index(edge.facet, static_cast<int>((edge.kind + 1) % 3));
    return {static_cast<std::uint64_t>(item.surface),
            (std::uint64_t{std::min(v, w)} << 32) | std::max(v, w)};
}

void LeafLinks::add_edge(LeafNode node, int k, const PlaneName& plane) {
    const LeafItem& item = item_of(node);
    if (is_own_edge(item.ref, plane)) {
        add_to_line(key_of_edge(item, plane), false, node, k);
    } else if (!is_splitter_of(work_->problem->cell, plane)) {
        // More names than bits: try_within_facet() compares them.
        const std::uint64_t facet =
            (std::uint64_t{item.ref.facet} << 32) | static_cast<std::uint64_t>(item.surface);
        const std::uint64_t name =
            plane.owner ^ mix64((std::uint64_t{plane.facet} << 3) | plane.kind);
        add_to_line({name | (std::uint64_t{1} << 63), facet}, true, node, k);
    }
}

LeafLinks::Line& LeafLinks::line_at(const Key128& key, bool within_facet) {
    const auto next = static_cast<LeafIndex>(lines_.size());
    const auto [id, inserted] = line_ids_.insert(key, next);
    if (inserted) {
        Line& line = lines_.emplace_back();
        line.within_facet = within_facet;
    }
    return lines_[as_index(id)];
}

void LeafLinks::count_facet(Line& line, std::uint32_t facet) {
    const bool listed = (line.facet_count > 0 && line.facets[0] == facet) ||
                        (line.facet_count > 1 && line.facets[1] == facet);
    if (!listed && line.facet_count < 2) line.facets[line.facet_count] = facet;
    if (!listed && line.facet_count < 3) ++line.facet_count;
}

void LeafLinks::count_at_edges(const LeafPiece& piece) {
    const LeafItem& item = work_->item(piece.item);
    for (const WorkEdge& e : piece.shape.edges)
        if (const PlaneName plane = work_->bench.name(e.plane); is_own_edge(item.ref, plane))
            count_facet(line_at(key_of_edge(item, plane), false), item.ref.facet);
}

void LeafLinks::add_to_line(const Key128& key, bool within_facet, LeafNode node, int k) {
    Line& line = line_at(key, within_facet);
    if (!within_facet) count_facet(line, item_of(node).ref.facet);
    edges_.push_back({node, k, line.first});
    line.first = static_cast<LeafIndex>(edges_.size()) - 1;
}

void LeafLinks::link_line(const Line& line) {
    for (LeafIndex i = line.first; i >= 0; i = edges_[as_index(i)].next) {
        const Edge& a = edges_[as_index(i)];
        if (!line.within_facet && line.facet_count != 2 &&
            !work_->operand_of(item_of(a.node)).embedded)
            return;
        for (LeafIndex j = a.next; j >= 0; j = edges_[as_index(j)].next) {
            const Edge& b = edges_[as_index(j)];
            if (tree_of(a.node) == tree_of(b.node)) continue;
            if (line.within_facet) {
                try_within_facet(a, b);
            } else {
                try_across_edge(a, b);
            }
        }
    }
}

PlaneName LeafLinks::plane_name(const Edge& e) {
    const PolygonRef& ref = item_of(e.node).ref;
    const auto k = static_cast<std::size_t>(e.k);
    if (e.node < items_ && ref.fragment != nullptr) return ref.fragment->edges()[k].plane;
    return work_->bench.name(shape_of(e.node).edges[k].plane);
}

LeafLinks::Ends LeafLinks::ends_of(const Edge& e) {
    const PolygonRef& ref = item_of(e.node).ref;
    if (e.node < items_ && ref.fragment == nullptr)
        return {approximate(ref.source->corner(ref.facet, e.k)),
                approximate(ref.source->corner(ref.facet, (e.k + 1) % 3))};
    const auto& points = shape_of(e.node).points;
    const auto k = static_cast<std::size_t>(e.k);
    return {work_->bench.approximation(points[k]),
            work_->bench.approximation(points[(k + 1) % points.size()])};
}

// Whether two edges on one line have an open part in common within the cell, for certain.
bool LeafLinks::overlap(const Edge& a, const Edge& b) {
    const auto in_cell = [&](const Edge& e) {
        return e.node >= items_ || item_of(e.node).contained;
    };
    const Ends s = ends_of(a);
    const Ends t = ends_of(b);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(s.a.c[k] - s.b.c[k]) > std::fabs(s.a.c[axis] - s.b.c[axis])) axis = k;
    const auto before = [&](const Approximation& p, const Approximation& q) {
        return p.c[axis] < q.c[axis];
    };
    const auto& [s_lo, s_hi] = std::minmax(s.a, s.b, before);
    const auto& [t_lo, t_hi] = std::minmax(t.a, t.b, before);
    const Approximation& lo = std::max(s_lo, t_lo, before);
    const Approximation& hi = std::min(s_hi, t_hi, before);
    // Whichever of the ends are the true ones, the middle part of the overlap is within both.
    const double error = std::max(s_lo.error, t_lo.error) + std::max(s_hi.error, t_hi.error);
    if (!(hi.c[axis] - lo.c[axis] > 256 * error)) return false;
    return in_cell(a) || in_cell(b) || certainly_enters(work_->problem->cell, lo, hi);
}

// Whether another surface may contain an open part of the edge.
bool LeafLinks::touched_along(const Edge& e) {
    const LeafIndex item = item_index(e.node);
    if (work_->contacts(item).empty()) return false;
    Workbench& bench = work_->bench;
    const auto& points = shape_of(e.node).points;
    const auto k = static_cast<std::size_t>(e.k);
    const PointId p = points[k];
    const PointId q = points[(k + 1) % points.size()];
    for (const LeafContact& c : work_->contacts(item)) {
        const PlaneId support = work_->item(c.other).shape.support;
        if (bench.side(p, support) != 0 || bench.side(q, support) != 0) continue;
        const auto& edges = work_->with_edges(c.other).edges;
        const bool apart = std::any_of(edges.begin(), edges.end(), [&](const WorkEdge& edge) {
            const int outside = edge.above ? -1 : 1;
            const int sp = bench.side(p, edge.plane) * outside;
            const int sq = bench.side(q, edge.plane) * outside;
            return sp >= 0 && sq >= 0 && sp + sq > 0;
        });
        if (!apart) return true;
    }
    return false;
}

// The polygons of other surfaces that contain the edge in their interiors, in `crossed_`; false
// when one contains a part of it in another way. What lies in the facet's own plane is not crossed.
bool LeafLinks::crossings_of(const Edge& e) {
    crossed_.clear();
    const LeafIndex item = item_index(e.node);
    Workbench& bench = work_->bench;
    const WorkPolygon& shape = shape_of(e.node);
    const auto k = static_cast<std::size_t>(e.k);
    const PointId p = shape.points[k];
    const PointId q = shape.points[(k + 1) % shape.points.size()];
    for (const LeafContact& c : work_->contacts(item)) {
        const PlaneId support = work_->item(c.other).shape.support;
        if (bench.side(p, support) != 0 || bench.side(q, support) != 0) continue;
        bool apart = false;
        bool within = true;
        for (const WorkEdge& edge : work_->with_edges(c.other).edges) {
            const int outside = edge.above ? -1 : 1;
            const int sp = bench.side(p, edge.plane) * outside;
            const int sq = bench.side(q, edge.plane) * outside;
            apart = apart || (sp >= 0 && sq >= 0 && sp + sq > 0);
            within = within && sp <= 0 && sq <= 0 && sp + sq < 0;
        }
        if (apart) continue;
        if (!within) return false;
        if (bench.plane_class(support) != bench.plane_class(shape.support))
            crossed_.push_back(c.other);
    }
    return true;
}

int LeafLinks::side_of_node(LeafNode node, PlaneId plane) {
    for (const PointId p : shape_of(node).points)
        if (const int s = work_->bench.side(p, plane); s != 0) return s;
    return 0;
}

void LeafLinks::try_within_facet(const Edge& a, const Edge& b) {
    const LeafItem& i = item_of(a.node);
    const LeafItem& j = item_of(b.node);
    const bool same_line =
        i.surface == j.surface && i.ref.facet == j.ref.facet && plane_name(a) == plane_name(b);
    if (!same_line || !overlap(a, b)) return;
    // Of two edges the shorter one is less likely to be partly overlapped.
    const auto length = [&](const Edge& e) {
        const Ends ends = ends_of(e);
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += std::fabs(ends.a.c[k] - ends.b.c[k]);
        return sum;
    };
    const Edge& e = length(a) <= length(b) ? a : b;
    if (!crossings_of(e)) return;
    crossing_changes_.clear();
    for (const LeafIndex t : crossed_) {
        const LeafItem& other = work_->item(t);
        const int side = side_of_node(a.node, other.shape.support);
        if (side == 0 || side_of_node(b.node, other.shape.support) != -side) return;
        crossing_changes_.push_back({other.operand, side * other.orientation});
    }
    for (const LeafIndex t : crossed_) {
        const LeafItem& other = work_->item(t);
        if (!work_->operand_of(other).embedded) continue;
        const int side = side_of_node(a.node, other.shape.support);
        note_known(a.node, other, side);
        note_known(b.node, other, -side);
    }
    join(a.node, b.node, crossing_changes_);
}

void LeafLinks::try_across_edge(const Edge& a, const Edge& b) {
    const LeafItem& i = item_of(a.node);
    const LeafItem& j = item_of(b.node);
    if (i.ref.facet == j.ref.facet) return;
    if (!work_->operand_of(i).embedded && i.orientation != j.orientation) return;
    const bool a_has_less =
        work_->contacts(item_index(a.node)).size() <= work_->contacts(item_index(b.node)).size();
    if (touched_along(a_has_less ? a : b) || !overlap(a, b)) return;
    join(a.node, b.node, {});
}

// `side`: where the node lies with respect to a polygon whose interior its edge runs through.
void LeafLinks::note_known(LeafNode node, const LeafItem& crossed, int side) {
    const int winding = side * crossed.orientation > 0 ? 0 : 1;
    known_.push_back({crossed.operand, winding, first_known_[as_index(node)]});
    first_known_[as_index(node)] = static_cast<LeafIndex>(known_.size()) - 1;
}

void LeafLinks::join(LeafNode a, LeafNode b, std::span<const LeafChange> changes) {
    ++work_->stats->linked;
    parent_[as_index(tree_of(a))] = tree_of(b);
    const auto first = static_cast<std::uint32_t>(changes_.size());
    const auto count = static_cast<std::uint32_t>(changes.size());
    changes_.insert(changes_.end(), changes.begin(), changes.end());
    links_.push_back({b, first_link_[as_index(a)], first, count, 1});
    first_link_[as_index(a)] = static_cast<LeafIndex>(links_.size()) - 1;
    links_.push_back({a, first_link_[as_index(b)], first, count, -1});
    first_link_[as_index(b)] = static_cast<LeafIndex>(links_.size()) - 1;
}

}  // namespace trisect::detail
