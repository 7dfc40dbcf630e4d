// SPDX-License-Identifier: Apache-2.0
//
// All that is asked of two facets is the sign of a determinant of four corners, and of six where an
// edge goes through two facets. Where such a sign is 0, it becomes that of the determinant's
// derivative along the shift, which is linear in it:
//     of a corner and a plane, the product of the plane's normal and the shift, which is never 0;
//     of two edges, that of the product of their directions and the shift; it is only asked where
//     each goes through the other one's plane, so the directions are not parallel;
//     of two planes along an edge, see order_along_shifted().
// (Edelsbrunner and Mücke, "Simulation of simplicity", 1990, move every corner by itself; one shift
// for a whole mesh is enough here, since a mesh is embedded and pairs are of two meshes.)
//
// Differences of coordinates are below 2^54, normals below 2^109, values of planes below 2^165.

#include <trisect/bsp/cells/shift/shifted_pairs.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/kernel/predicates.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Whole = std::array<std::int64_t, 3>;
using Normal = std::array<Int128, 3>;
using Value = WideInt<3>;

Whole whole(const LatticePoint& p) {
    return {p.x.to_integer(), p.y.to_integer(), p.z.to_integer()};
}

Whole operator-(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Normal cross(const Whole& u, const Whole& v) {
    Normal n{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        n[k] = Int128{u[i]} * v[j] - Int128{u[j]} * v[i];
    }
    return n;
}

Value dot(const Normal& n, const Whole& v) {
    Value sum;
    for (std::size_t k = 0; k < 3; ++k) sum += multiply<3>(WideInt<2>(n[k]), WideInt<1>(v[k]));
    return sum;
}

int sign_of(Int128 v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

std::array<int, 3> signs_of(const Normal& n) {
    return {sign_of(n[0]), sign_of(n[1]), sign_of(n[2])};
}

struct Facet {
    std::array<Whole, 3> corners{};
    Normal normal{};

    explicit Facet(const FacetCorners& points) {
        for (std::size_t i = 0; i < 3; ++i) corners[i] = whole(*points[i]);
        normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    }
    [[nodiscard]] Value value(const Whole& p) const { return dot(normal, p - corners[0]); }
};

// The corners of a facet and the plane of another one; `derivative` is the sign of what the shift
// adds to their values.
struct CornerSigns {
    std::array<double, 3> value{};  // off by less than 2^-51 of it
    std::array<int, 3> sign{};
    unsigned on = 0;  // without the shift
    int above = 0;

    CornerSigns(const Facet& plane, const Facet& facet, int derivative) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Value v = plane.value(facet.corners[i]);
            value[i] = v.to_double();
            sign[i] = v.sign();
            if (sign[i] == 0) {
                on |= 1U << i;
                sign[i] = derivative;
            }
            above += sign[i] > 0 ? 1 : 0;
        }
    }
    [[nodiscard]] bool is_off() const { return above == 0 || above == 3; }
    /// The corner that is alone on its side. \pre not is_off()
    [[nodiscard]] std::size_t lonely() const {
        const int alone = above == 1 ? 1 : -1;
        return sign[0] == alone ? 0 : (sign[1] == alone ? 1 : 2);
    }
};

// A facet's corners, the lonely one first, and turned over if need be so that the other facet's
// lonely corner is above it (filtered_pair_relation.cpp).
struct NumberedCorners {
    std::array<std::size_t, 3> corner;
    const std::array<Whole, 3>& points;

    NumberedCorners(const std::array<Whole, 3>& all, std::size_t lonely, bool turned)
        : points(all) {
        corner = {lonely, (lonely + 1) % 3, (lonely + 2) % 3};
        if (turned) std::swap(corner[1], corner[2]);
    }
    [[nodiscard]] const Whole& operator[](std::size_t i) const { return points[corner[i]]; }
    [[nodiscard]] std::int8_t edge_to(std::size_t i) const {
        const std::size_t a = corner[0];
        const std::size_t b = corner[i];
        return static_cast<std::int8_t>(b == (a + 1) % 3 ? a : b);
    }
};

// The point between two corners where a plane's value is 0. The part of the way is off by less than
// 2^-49.
Approximation between(const LatticePoint& a, double value_a, const LatticePoint& b,
                      double value_b) {
    const std::array<double, 3> from = a.doubles();
    const std::array<double, 3> to = b.doubles();
    const double part = std::fabs(value_a) / (std::fabs(value_a) + std::fabs(value_b));
    Approximation x;
    double span = 0;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = to[k] - from[k];
        x.c[k] = from[k] + part * step;
        span = std::max(span, std::fabs(step));
        largest = std::max({largest, std::fabs(from[k]), std::fabs(to[k])});
    }
    x.error = span * 0x1p-48 + largest * 0x1p-50;
    return x;
}

// Where the edge from the lonely corner to corner i goes through the other plane.
void set_end(const FacetCorners& points, const NumberedCorners& t, const CornerSigns& sides,
             std::size_t i, bool of_second, FacetCrossing::End& end) {
    end.of_second = of_second;
    end.edge = t.edge_to(i);
    end.corner = -1;
    const std::size_t from = t.corner[0];
    const std::size_t to = t.corner[i];
    for (const std::size_t c : {from, to}) {
        if ((sides.on >> c & 1U) == 0) continue;
        end.corner = static_cast<std::int8_t>(c);
        end.at = approximate(*points[c]);
        return;
    }
    end.at = between(*points[from], sides.value[from], *points[to], sides.value[to]);
}

bool are_equal(const FacetCorners& a, const FacetCorners& b) {
    return std::ranges::all_of(a, [&](const LatticePoint* p) {
        return std::ranges::any_of(b, [&](const LatticePoint* q) { return *p == *q; });
    });
}

bool point_the_same_way(const Normal& a, const Normal& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (const int s = sign_of(a[k]); s != 0) return s == sign_of(b[k]);
    return true;
}

}  // namespace

ShiftedPair relate_shifted(const FacetCorners& first, const FacetCorners& second,
                           const InfinitesimalShift& shift) {
    ShiftedPair out;
    const Facet a(first);
    const Facet b(second);
    if (are_equal(first, second)) {
        out.kind = ShiftedPair::Kind::Equal;
        out.same_side = point_the_same_way(a.normal, b.normal);
        return out;
    }
    const CornerSigns of_b(a, b, shift.along(signs_of(a.normal)));
    if (of_b.on == 7) {
        out.kind = ShiftedPair::Kind::Coplanar;
        out.is_above = of_b.above == 3;
        out.same_side = point_the_same_way(a.normal, b.normal);
        return out;
    }
    if (of_b.is_off()) {
        out.touches = of_b.on != 0;
        return out;
    }
    const CornerSigns of_a(b, a, -shift.along(signs_of(b.normal)));
    out.touches = of_b.on != 0 || of_a.on != 0;
    if (of_a.is_off()) {
        out.touches = of_a.on != 0;
        return out;
    }
    const std::size_t lonely_a = of_a.lonely();
    const std::size_t lonely_b = of_b.lonely();
    const bool turned_a = of_b.sign[lonely_b] < 0;
    const bool turned_b = of_a.sign[lonely_a] < 0;
    const NumberedCorners p(a.corners, lonely_a, turned_a);
    const NumberedCorners q(b.corners, lonely_b, turned_b);
    // The sign of det(p0 - qj, pi - qj, q0 - qj); its derivative is (pi - p0) × (qj - q0).
    const auto order = [&](std::size_t i, std::size_t j) {
        const Normal n = cross(p[i] - q[j], q[0] - q[j]);
        const int sign = dot(n, p[0] - q[j]).sign();
        if (sign != 0) return sign;
        out.touches = true;
        return shift.along(signs_of(cross(p[i] - p[0], q[j] - q[0])));
    };
    // What decides that they are apart decides it without the shift as well, if it does not need
    // it.
    const auto apart = [&](bool needed_shift) {
        out.touches = needed_shift;
        return out;
    };
    const bool touches = out.touches;
    out.touches = false;
    if (order(1, 1) < 0) return apart(out.touches);
    const bool start_touches = std::exchange(out.touches, false);
    if (order(2, 2) > 0) return apart(out.touches);
    out.touches = out.touches || start_touches || touches;
    const int starts = order(2, 1);
    const int ends = order(1, 2);
    out.kind = ShiftedPair::Kind::Crossing;
    const auto set = [&](FacetCrossing::End& end, bool of_second, std::size_t corner) {
        if (of_second) {
            set_end(second, q, of_b, corner, true, end);
        } else {
            set_end(first, p, of_a, corner, false, end);
        }
    };
    // The later start and the earlier end.
    const std::size_t start = turned_a != turned_b ? 1 : 0;
    set(out.ends[start], starts < 0, starts < 0 ? 1 : 2);
    set(out.ends[1 - start], ends > 0, ends > 0 ? 2 : 1);
    return out;
}

// Where they are apart, or have only outlines in common, an edge of one of them parts them.
Overlap coplanar_overlap(const FacetCorners& first, const FacetCorners& second) {
    const std::array<Facet, 2> facets{Facet(first), Facet(second)};
    Overlap out = Overlap::Insides;
    std::size_t axis = 0;
    while (axis < 2 && facets[0].normal[axis] == 0) ++axis;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
        const Facet& f = facets[side];
        const Facet& g = facets[1 - side];
        const int inner = sign_of(f.normal[axis]);
        for (std::size_t e = 0; e < 3; ++e) {
            const Whole& from = f.corners[e];
            const Whole along = f.corners[(e + 1) % 3] - from;
            int nearest = -1;
            for (const Whole& p : g.corners) {
                const Whole to = p - from;
                nearest = std::max(
                    nearest, inner * sign_of(Int128{along[u]} * to[v] - Int128{along[v]} * to[u]));
            }
            if (nearest < 0) return Overlap::None;
            if (nearest == 0) out = Overlap::Outlines;
        }
    }
    return out;
}

std::array<int, 3> normal_signs(const FacetCorners& facet) { return signs_of(Facet(facet).normal); }

// An edge from p to q goes through the plane of normal n and value v at v(p) / (v(p) - v(q)) of its
// length. A shift s of the plane takes n·s from v(p), one of the edge adds it, and either leaves
// the difference as it is.
int order_along_shifted(const LatticePoint& from, const LatticePoint& to, bool is_second,
                        const FacetCorners& one, const FacetCorners& other,
                        const InfinitesimalShift& shift) {
    const std::array<Facet, 2> facets{Facet(one), Facet(other)};
    const Whole p = whole(from);
    const Whole q = whole(to);
    std::array<Value, 2> start;
    std::array<Value, 2> drop;
    for (std::size_t i = 0; i < 2; ++i) {
        start[i] = facets[i].value(p);
        drop[i] = start[i] - facets[i].value(q);
    }
    const int drops = drop[0].sign() * drop[1].sign();
    const auto ahead = multiply<6>(start[0], drop[1]) - multiply<6>(start[1], drop[0]);
    if (const int sign = ahead.sign(); sign != 0) return sign * drops;
    std::array<int, 3> moved;
    for (std::size_t k = 0; k < 3; ++k)
        moved[k] = (multiply<5>(WideInt<2>(facets[0].normal[k]), drop[1]) -
                    multiply<5>(WideInt<2>(facets[1].normal[k]), drop[0]))
                       .sign();
    const int sign = shift.along(moved) * drops;
    return is_second ? sign : -sign;
}

}  // namespace trisect::detail
