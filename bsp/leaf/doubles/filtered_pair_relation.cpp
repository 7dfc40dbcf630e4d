// SPDX-License-Identifier: Apache-2.0
//
// Of two whole facets a few signs decide (triangle_relation.cpp), and of more than two operands
// single precision decides as much for four pairs at once (facet_row_relation.cpp); what it leaves
// open comes here.
//
// Chains of cuts by one tool bring more: where a symmetric tool moves by equal steps along two axes
// four of its facets have a point in common, so corners of fragments lie on the next tool's facets
// at every step. With the sides of such corners known exactly the rest is the same: an interval may
// begin at a corner, or be a single point. Two polygons with no more than a point in common do not
// change each other's winding numbers; but at a corner on another operand there are none, so such
// corners are marked (FilteredFacet::resting). An edge in another support is left to the exact
// path.

#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/bsp/leaf/doubles/triangle_relation.h>
#include <trisect/kernel/number/orientation.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace trisect::detail {

namespace {

// -1, 0, 1: on which side of a plane a corner of an item's outline is. Exact.
int exact_side(const FilteredFacet& f, std::size_t i, const Plane& plane) {
    const PolygonRef& ref = f.ref;
    if (const int corner = f.mesh_corner(i); corner >= 0)
        return sign_of(side_of(ref.source->corner(ref.facet, corner), plane));
    return sign_of(side_of(ref.fragment->vertices()[i], ref.source->support(ref.facet),
                           f.edge(i == 0 ? f.size - 1U : i - 1).plane.plane(),
                           f.edge(i).plane.plane(), plane));
}

// Without a call, which std::has_single_bit is on the oldest processors of the family.
bool is_single(std::uint32_t bits) { return bits != 0 && (bits & (bits - 1)) == 0; }

// A polygon and the side of another one's support on which its corners are.
class Across {
public:
    Across(const FilteredFacets& facets, const FilteredFacet& f, const FilteredPlane& plane)
        : facets_(facets), f_(f) {
        const auto add = [&](std::size_t i, double value, double error) {
            value_[i] = value;
            error_[i] = error;
            above_ |= (value > error ? 1U : 0U) << i;
            below_ |= (value < -error ? 1U : 0U) << i;
        };
        if (f.is_whole()) {
            for (std::size_t i = 0; i < 3; ++i) add(i, plane.value(f.corners[i]), plane.bound);
        } else {
            const Approximation* const corners = facets.outline(f);
            for (std::size_t i = 0; i < f.size; ++i)
                add(i, plane.value(corners[i].c), plane.error(corners[i]));
        }
        on_ = ((1U << f.size) - 1) & ~(above_ | below_);
    }
    /// Corners that doubles do not decide count as being on the support until this is called.
    [[nodiscard]] bool is_sure() const { return on_ == 0; }
    void make_sure(const FilteredFacet& other) {
        const Plane plane = other.ref.source->support(other.ref.facet);
        for (std::uint32_t rest = on_; rest != 0; rest &= rest - 1) {
            const std::uint32_t bit = rest & (~rest + 1);
            const int side =
                exact_side(f_, static_cast<std::size_t>(std::countr_zero(rest)), plane);
            if (side == 0) continue;
            (side > 0 ? above_ : below_) |= bit;
            on_ &= ~bit;
        }
    }
    [[nodiscard]] bool is_off() const { return on_ == 0 && (above_ == 0 || below_ == 0); }
    [[nodiscard]] bool crosses() const { return above_ != 0 && below_ != 0; }
    [[nodiscard]] std::uint32_t above() const { return above_; }
    [[nodiscard]] std::uint32_t on() const { return on_; }
    /// The edges that go up and down through the support, or to a corner on it; false unless there
    /// is one of each, or an edge lies in it. \pre not is_off()
    [[nodiscard]] bool find_edges() {
        if ((on_ & next_of(on_)) != 0) return false;
        const std::uint32_t upper = above_ != 0 ? above_ : on_;
        const std::uint32_t up = next_of(upper) & ~upper;
        const std::uint32_t down = upper & ~next_of(upper);
        up_ = static_cast<std::size_t>(std::countr_zero(up));
        down_ = static_cast<std::size_t>(std::countr_zero(down));
        return is_single(up) && is_single(down);
    }
    [[nodiscard]] std::size_t edge(bool up) const { return up ? up_ : down_; }
    /// Where one of these edges is in the support. False when doubles do not decide enough.
    [[nodiscard]] bool pierce(bool up, Approximation& x) const {
        const std::size_t i = edge(up);
        const std::size_t next = i + 1U < f_.size ? i + 1 : 0;
        for (const std::size_t end : {i, next}) {
            if ((on_ >> end & 1U) == 0) continue;
            x = facets_.corner(f_, end);
            return true;
        }
        return interpolate(facets_.corner(f_, i), value_[i], facets_.corner(f_, next), value_[next],
                           error_[i] + error_[next], x);
    }

private:
    // What is said of a corner, said of the one before it.
    [[nodiscard]] std::uint32_t next_of(std::uint32_t corners) const {
        return corners >> 1 | (corners & 1U) << (f_.size - 1U);
    }

    const FilteredFacets& facets_;
    const FilteredFacet& f_;
    std::array<double, FilteredFacet::max_outline> value_;
    std::array<double, FilteredFacet::max_outline> error_;
    std::uint32_t above_ = 0;
    std::uint32_t below_ = 0;
    std::uint32_t on_ = 0;
    std::size_t up_ = 0;
    std::size_t down_ = 0;
};

// The point `at` where an edge of a pierces the support of b, upwards or downwards: 1 on the inner
// side of an edge of b, -1 on the outer one, 0 on it. Exact.
int side_of_edge(const FilteredFacet& a, std::size_t edge_a, bool up, const Approximation& at,
                 const FilteredFacets& facets, const FilteredFacet& b, std::size_t edge_b) {
    const int mesh_a = a.mesh_edge(edge_a);
    const int mesh_b = b.mesh_edge(edge_b);
    if (mesh_a >= 0 && mesh_b >= 0) {
        const auto end = [](const FilteredFacet& f, int i) -> const Vector3& {
            return f.corners[static_cast<std::size_t>(i % 3)];
        };
        // For a line that goes up through p, det(w - u, p - u, q - u) > 0 where it passes on the
        // left of the way from p to q.
        const auto orientation =
            facets.is_whole() ? exact_orientation : exact_orientation_of_fractions;
        const auto s =
            orientation(end(a, mesh_a + 1), end(b, mesh_b), end(b, mesh_b + 1), end(a, mesh_a));
        if (s) return up ? *s : -*s;
    }
    const EdgeName edge = b.edge(edge_b);
    const PlaneName from = a.edge(edge_a).plane;
    if (from == edge.plane) return 0;
    const int s =
        sign_of(side_of(facets.in_lattice(at), a.ref.source->support(a.ref.facet), from.plane(),
                        b.ref.source->support(b.ref.facet), edge.plane.plane()));
    return edge.above ? s : -s;
}

// Surely: a segment on a splitting plane is not.
bool is_outside_cell(const FilteredFacets& facets, const Approximation& a, const Approximation& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = facets.splitter_lo()[k];
        const double high = facets.splitter_hi()[k];
        const double slack = 2 * (a.error + b.error + facets.splitter_error()) +
                             0x1p-50 * (std::fabs(low) + std::fabs(high));
        if (std::max(a.c[k], b.c[k]) + slack < low || std::min(a.c[k], b.c[k]) - slack > high)
            return true;
    }
    return false;
}

// Of whole facets. False when doubles say too little of where the ends are.
bool set_crossing(const FilteredFacets& facets, LeafIndex s, LeafIndex t, const TriangleRelation& r,
                  FilteredCrossing& out) {
    const TriangleAndPlane first{facets[s].corners, facets[s].plane};
    const TriangleAndPlane second{facets[t].corners, facets[t].plane};
    out.items = {s, t};
    out.above = r.above;
    out.on = {};
    for (std::size_t k = 0; k < 2; ++k) {
        const TriangleRelation::End end = r.end(k);
        out.ends[k].of_second = end.of_second;
        out.ends[k].edge = end.edge.edge(end.up);
        out.ends[k].other_edge = -1;
        if (!find_end(first, second, end, out.ends[k].at)) return false;
    }
    return true;
}

}  // namespace

bool FilteredPairs::add_pair(FilteredFacets& facets, LeafIndex s, LeafIndex t) {
    if (facets[s].is_beyond || facets[t].is_beyond) return true;
    const Relation r = relate(facets, std::min(s, t), std::max(s, t), found_);
    // Outside the cell is as good as nowhere.
    if (r == Relation::Crossing && !is_outside_cell(facets, found_.ends[0].at, found_.ends[1].at))
        crossings_.push_back(found_);
    return r != Relation::Uncertain;
}

// A pair of which the crossing is known but for where its ends are; `i`: its place among four.
bool FilteredPairs::add_crossing(const FilteredFacets& facets, LeafIndex s, LeafIndex t,
                                 const FacetRows::Relation& relation, unsigned i) {
    FilteredCrossing& out = found_;
    const TriangleRelation r(relation, i);
    if (!(s < t ? set_crossing(facets, s, t, r, out) : set_crossing(facets, t, s, r.turned(), out)))
        return false;
    if (facets[s].contained || facets[t].contained ||
        !is_outside_cell(facets, out.ends[0].at, out.ends[1].at))
        crossings_.push_back(out);
    return true;
}

FilteredPairs::Relation FilteredPairs::relate(FilteredFacets& facets, LeafIndex s, LeafIndex t,
                                              FilteredCrossing& out) const {
    if (!facets[s].is_whole() || !facets[t].is_whole()) return relate_outlines(facets, s, t, out);
    const FilteredPlane& plane_s = facets.plane(s);
    const FilteredPlane& plane_t = facets.plane(t);
    const TriangleRelation r =
        relate_triangles({facets[s].corners, plane_s}, {facets[t].corners, plane_t});
    switch (r.kind) {
        case TriangleRelation::Kind::Apart:
            return Relation::Apart;
        case TriangleRelation::Kind::Crossing:
            return set_crossing(facets, s, t, r, out) ? Relation::Crossing : Relation::Uncertain;
        case TriangleRelation::Kind::NearPlane:
            // Where edges are taken to be apart, relate_outlines() would look at the same values
            // again.
            if (edges_apart_) return Relation::Uncertain;
            break;
        case TriangleRelation::Kind::NearEdges:
            break;
    }
    return relate_outlines(facets, s, t, out);
}

FilteredPairs::Relation FilteredPairs::relate_outlines(FilteredFacets& facets, LeafIndex s,
                                                       LeafIndex t, FilteredCrossing& out) const {
    const FilteredPlane& plane_s = facets.plane(s);
    const FilteredPlane& plane_t = facets.plane(t);
    Across b(facets, facets[t], plane_s);
    if (b.is_off()) return Relation::Apart;
    Across a(facets, facets[s], plane_t);
    if (a.is_off()) return Relation::Apart;
    if (!a.is_sure() || !b.is_sure()) {
        if (edges_apart_) return Relation::Uncertain;
        a.make_sure(facets[t]);
        b.make_sure(facets[s]);
        if (a.is_off() || b.is_off()) return Relation::Apart;
        facets[s].resting |= a.on();
        facets[t].resting |= b.on();
    }
    if (!a.find_edges() || !b.find_edges()) return Relation::Uncertain;
    const LineDirection direction(plane_s, plane_t);
    if (direction.sign == 0) return Relation::Uncertain;
    // In the direction of the normals' product, what is below a support is to the left of the line
    // in the other one's plane, if that comes first, and to the right if it comes second. So a
    // begins with the edge that goes up, b with the one that goes down.
    std::array<Approximation, 2> ends_a;
    std::array<Approximation, 2> ends_b;
    if (!a.pierce(true, ends_a[0]) || !a.pierce(false, ends_a[1]) || !b.pierce(false, ends_b[0]) ||
        !b.pierce(true, ends_b[1]))
        return Relation::Uncertain;
    // -1: end i of a comes before end j of b.
    bool edges_meet = false;
    const auto order = [&](std::size_t i, std::size_t j) {
        const int o = direction.order(ends_a[i], ends_b[j]);
        if (o != 0) return o;
        const int side = side_of_edge(facets[s], a.edge(i == 0), i == 0, ends_a[i], facets,
                                      facets[t], b.edge(j == 1));
        edges_meet = edges_meet || side == 0;
        // Within b as far as that edge goes: behind its start, before its end.
        return j == 0 ? side : -side;
    };
    const bool apart = order(1, 0) <= 0 || order(0, 1) >= 0;
    const int starts = apart ? 0 : order(0, 0);
    const int ends = apart ? 0 : order(1, 1);
    if (edges_meet) {
        if (edges_apart_) return Relation::Uncertain;
        facets[s].ref.touched = facets[t].ref.touched = true;
    }
    if (apart) return Relation::Apart;
    if (!a.crosses() || !b.crosses()) {
        // A corner of one of them lies within the other one.
        facets[s].ref.touched = facets[t].ref.touched = true;
        return Relation::Apart;
    }
    out.items = {s, t};
    out.above = {a.above(), b.above()};
    out.on = {a.on(), b.on()};
    // The later start and the earlier end.
    const auto end_of = [&](int which, std::size_t i) {
        const bool of_b = which > 0;
        const auto edge_a = static_cast<std::int8_t>(a.edge(i == 0));
        const auto edge_b = static_cast<std::int8_t>(b.edge(i == 1));
        FilteredEnd end{of_b, of_b ? edge_b : edge_a, -1, (of_b ? ends_b : ends_a)[i]};
        if (which == 0) end.other_edge = edge_b;
        return end;
    };
    out.ends = {end_of(-starts, 0), end_of(ends, 1)};
    return Relation::Crossing;
}

}  // namespace trisect::detail
