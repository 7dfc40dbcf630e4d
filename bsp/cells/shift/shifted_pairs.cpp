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
// A mesh that grows by a factor 1 + d about c has each corner x moved by d (x - c). Directions of
// its edges stay, and its normals are multiplied by (1 + d)^2, so all determinants are linear in d,
// up to a positive factor. Of a plane, normal · (x - c) for its own points x is what the plane's
// value is at c, negated. Where a derivative by d is 0, so is the determinant for all d, and the
// shift along the axes decides.
//
// Doubles come first: most signs are not near 0, and those about a plane across an axis are 0 with
// certainty. A determinant of four corners that they leave open is computed in integers; where
// another sign is open, all is done once more in integers.

#include <trisect/bsp/cells/shift/shifted_pairs.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <type_traits>
#include <utility>

#include <trisect/bsp/cells/shift/corner_derivatives.h>
#include <trisect/bsp/cells/shift/corner_orders.h>
#include <trisect/bsp/cells/shift/corner_passages.h>
#include <trisect/bsp/cells/shift/near_numbers.h>
#include <trisect/bsp/cells/shift/shift_numbers.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

using namespace shifted;

// The shift as derivatives of signs.
template <class N>
class Derivatives {
public:
    static constexpr bool is_uniform = true;  // the same for all corners of a facet

    Derivatives(const N& numbers, const InfinitesimalShift& shift)
        : numbers_(numbers),
          shift_(shift),
          growths_{{{shift.growth, lengths<N>(shift.centre)},
                    {shift.next_growth, lengths<N>(shift.next_centre)}}} {}

    // Of the value that a facet's plane has at points of the mesh that is moved, in the plane. That
    // of a moved plane at points in it is the negative of this.
    [[nodiscard]] int of_value(const Facet<N>& facet) const {
        for (const Growth& g : growths_) {
            if (g.sign == 0) break;
            const int sign = numbers_.sign(facet.value(g.centre));
            if (sign != 0) return -g.sign * sign;
        }
        return sign_along(numbers_, shift_, facet.normal);
    }
    [[nodiscard]] int of_corner(const Facet<N>& first, std::size_t) const {
        return of_value(first);
    }
    [[nodiscard]] int of_plane(const Facet<N>& second, const Lengths<N>&) const {
        return -of_value(second);
    }
    // Of det(p0 - qj, pi - qj, q0 - qj), by corners q of the second facet.
    [[nodiscard]] int of_edges(const std::array<Lengths<N>, 2>& p,
                               const std::array<Lengths<N>, 2>& q, std::size_t, std::size_t) const {
        return of_product(cross<N>(minus(p[1], p[0]), minus(q[1], q[0])), q[0], [&](std::size_t k) {
            return exact_product<N>(p[0], p[1], q[0], q[1], k);
        });
    }
    // Of the product of a vector and a point that is moved.
    [[nodiscard]] int of_product(const Normal<N>& n, const Lengths<N>& point) const {
        return of_product(n, point, [](std::size_t) { return std::optional<double>(); });
    }

private:
    template <class Exactly>
    [[nodiscard]] int of_product(const Normal<N>& n, const Lengths<N>& point,
                                 const Exactly& exactly) const {
        for (const Growth& g : growths_) {
            if (g.sign == 0) break;
            const int sign = numbers_.sign(dot<N>(n, minus(point, g.centre)));
            if (sign != 0) return g.sign * sign;
        }
        return sign_along(numbers_, shift_, n, exactly);
    }

    struct Growth {
        int sign = 0;
        Lengths<N> centre;
    };
    const N& numbers_;
    const InfinitesimalShift& shift_;
    std::array<Growth, 2> growths_;
};

// The corners of a facet and the plane of another one; `derivative` gives the sign of what the
// shift adds to the value of a corner, the same for all where it is uniform.
template <class N>
struct CornerSigns {
    std::array<double, 3> value{};
    std::array<double, 3> error{};
    std::array<int, 3> sign{};
    unsigned on = 0;  // without the shift
    int above = 0;

    template <bool IsUniform, class Derivative>
    CornerSigns(const N& numbers, const Facet<N>& plane, const Facet<N>& facet,
                std::bool_constant<IsUniform>, const Derivative& derivative) {
        for (std::size_t i = 0; i < 3; ++i) {
            const typename N::Value v = plane.value(facet.corners[i]);
            value[i] = numbers.to_double(v);
            error[i] = numbers.error_of(v);
            sign[i] = numbers.sign(
                v, [&] { return N::is_in_plane(facet.corners[i], plane.corners, plane.normal); },
                [&] { return plane.exact_value(facet.corners[i]); });
            if (sign[i] == 0) on |= 1U << i;
        }
        int moved = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (sign[i] == 0) {
                if (!IsUniform || moved == 0) moved = derivative(i);
                sign[i] = moved;
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
template <class N>
struct NumberedCorners {
    std::array<std::size_t, 3> corner;
    const std::array<Lengths<N>, 3>& points;

    NumberedCorners(const std::array<Lengths<N>, 3>& all, std::size_t lonely, bool turned)
        : points(all) {
        corner = {lonely, (lonely + 1) % 3, (lonely + 2) % 3};
        if (turned) std::swap(corner[1], corner[2]);
    }
    [[nodiscard]] const Lengths<N>& operator[](std::size_t i) const { return points[corner[i]]; }
    [[nodiscard]] std::int8_t edge_to(std::size_t i) const {
        const std::size_t a = corner[0];
        const std::size_t b = corner[i];
        return static_cast<std::int8_t>(b == (a + 1) % 3 ? a : b);
    }
};

// A point between two corners is off by so much of the way at most.
constexpr double most_off = 0x1p-44;

// The point between two corners where a plane's value is 0; `off`: of the part of the way.
Approximation between(const std::array<const LatticePoint*, 2>& points, double part, double off) {
    const std::array<double, 3> from = points[0]->doubles();
    const std::array<double, 3> to = points[1]->doubles();
    Approximation x;
    double span = 0;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = to[k] - from[k];
        x.c[k] = from[k] + part * step;
        span = std::max(span, std::fabs(step));
        largest = std::max({largest, std::fabs(from[k]), std::fabs(to[k])});
    }
    x.error = span * (off + 0x1p-49) + largest * 0x1p-50;
    return x;
}

// The values of a plane at both ends of an edge through it.
struct EndValues {
    std::array<double, 2> size;
    double error;

    [[nodiscard]] double drop() const { return size[0] + size[1]; }
    [[nodiscard]] double part() const { return size[0] / drop(); }
    // Of the part of the way: by the values, and by roundings of the quotient.
    [[nodiscard]] double off() const { return 2 * (error / drop()) + 0x1p-51; }
};

// A bound on it.
double length_of(const LatticePoint& from, const LatticePoint& to) {
    const std::array<double, 3> a = from.doubles();
    const std::array<double, 3> b = to.doubles();
    double out = 0;
    for (std::size_t k = 0; k < 3; ++k) out += std::fabs(a[k] - b[k]);
    return 1.125 * out;
}

// Where the edge from the lonely corner to corner i goes through the other plane.
template <class N>
void set_end(const N& numbers, const FacetCorners& points, const NumberedCorners<N>& t,
             const CornerSigns<N>& sides, const Facet<N>& plane, std::size_t i, bool of_second,
             FacetCrossing::End& end) {
    end.of_second = of_second;
    end.edge = t.edge_to(i);
    end.corner = -1;
    std::size_t from = t.corner[0];
    std::size_t to = t.corner[i];
    const auto is_on = [&](std::size_t c) { return (sides.on >> c & 1U) != 0; };
    // Where the edge lies in the plane and its ends go to different sides, any place along it is as
    // good, but the same for both facets of the edge.
    const bool is_along = is_on(from) && is_on(to);
    if (is_along && points[to]->doubles() < points[from]->doubles()) std::swap(from, to);
    for (const std::size_t c : {from, to}) {
        if (!is_on(c)) continue;
        end.corner = static_cast<std::int8_t>(c);
        end.at = approximate(*points[c]);
        if (is_along) end.at.error = length_of(*points[from], *points[to]);
        return;
    }
    EndValues values{{std::fabs(sides.value[from]), std::fabs(sides.value[to])},
                     sides.error[from] + sides.error[to]};
    if (values.off() > most_off) {
        const auto at_from = plane.exact_value(t.points[from]);
        const auto at_to = plane.exact_value(t.points[to]);
        if (at_from && at_to) {
            values.size = {std::fabs(*at_from), std::fabs(*at_to)};
            values.error = 0x1p-51 * values.drop();
        } else {
            numbers.leave_open();
        }
    }
    end.at = between({points[from], points[to]}, values.part(), values.off());
}

bool are_equal(const FacetCorners& a, const FacetCorners& b) {
    return std::ranges::all_of(a, [&](const LatticePoint* p) {
        return std::ranges::any_of(b, [&](const LatticePoint* q) { return *p == *q; });
    });
}

template <class N>
bool point_the_same_way(const N& numbers, const Normal<N>& a, const Normal<N>& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (const int s = numbers.sign(a[k]); s != 0) return s == numbers.sign(b[k]);
    return true;
}

bool are_whole(std::initializer_list<const FacetCorners*> facets) {
    return std::ranges::all_of(facets, [](const FacetCorners* f) {
        return std::ranges::all_of(*f, [](const LatticePoint* p) { return p->is_whole(); });
    });
}

template <class N, class Moves>
ShiftedPair relate(const N& numbers, const FacetCorners& first, const FacetCorners& second,
                   const Moves& derivatives) {
    ShiftedPair out;
    const Facet<N> a(first);
    const Facet<N> b(second);
    constexpr std::bool_constant<Moves::is_uniform> is_uniform;
    const CornerSigns<N> of_b(numbers, a, b, is_uniform,
                              [&](std::size_t i) { return derivatives.of_corner(a, i); });
    const bool are_corners_equal = are_equal(first, second);
    if (of_b.on == 7 || are_corners_equal) {
        out.same_side = point_the_same_way(numbers, a.normal, b.normal);
        out.is_above = of_b.above == 3;
        out.is_torn = !of_b.is_off();
    }
    if (are_corners_equal) {
        out.kind = ShiftedPair::Kind::Equal;
        return out;
    }
    if (of_b.on == 7 && !out.is_torn) {
        out.kind = ShiftedPair::Kind::Coplanar;
        return out;
    }
    if (of_b.is_off()) {
        out.touches = of_b.on != 0;
        return out;
    }
    const CornerSigns<N> of_a(numbers, b, a, is_uniform,
                              [&](std::size_t i) { return derivatives.of_plane(b, a.corners[i]); });
    out.touches = of_b.on != 0 || of_a.on != 0;
    if (of_a.is_off()) {
        out.touches = of_a.on != 0;
        return out;
    }
    const std::size_t lonely_a = of_a.lonely();
    const std::size_t lonely_b = of_b.lonely();
    const bool turned_a = of_b.sign[lonely_b] < 0;
    const bool turned_b = of_a.sign[lonely_a] < 0;
    const NumberedCorners<N> p(a.corners, lonely_a, turned_a);
    const NumberedCorners<N> q(b.corners, lonely_b, turned_b);
    // The sign of det(p0 - qj, pi - qj, q0 - qj); its derivative is (pi - p0) × (qj - q0).
    const auto order = [&](std::size_t i, std::size_t j) {
        const Normal<N> n = cross<N>(minus(p[i], q[j]), minus(q[0], q[j]));
        const int sign = numbers.sign(
            dot<N>(n, minus(p[0], q[j])), [&] { return N::do_meet(p[0], p[i], q[0], q[j]); },
            [&] { return exact_determinant<N>(p[0], p[i], q[0], q[j]); });
        if (sign != 0) return sign;
        out.touches = true;
        return derivatives.of_edges({p[0], p[i]}, {q[0], q[j]}, q.corner[0], q.corner[j]);
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
            set_end(numbers, second, q, of_b, a, corner, true, end);
        } else {
            set_end(numbers, first, p, of_a, b, corner, false, end);
        }
    };
    // The later start and the earlier end.
    const std::size_t start = turned_a != turned_b ? 1 : 0;
    set(out.ends[start], starts < 0, starts < 0 ? 1 : 2);
    set(out.ends[1 - start], ends > 0, ends > 0 ? 2 : 1);
    return out;
}

template <class N>
ShiftedPair relate(const N& numbers, const FacetCorners& first, const FacetCorners& second,
                   const InfinitesimalShift& shift) {
    return shift.moves == nullptr
               ? relate(numbers, first, second, Derivatives<N>(numbers, shift))
               : relate(numbers, first, second, CornerDerivatives<N>(numbers, shift, second));
}

// Where they are apart, or have only outlines in common, an edge of one of them parts them.
template <class N>
Overlap overlap(const N& numbers, const FacetCorners& first, const FacetCorners& second) {
    const std::array<Facet<N>, 2> facets{Facet<N>(first), Facet<N>(second)};
    Overlap out = Overlap::Insides;
    std::size_t axis = 0;
    while (axis < 2 && numbers.sign(facets[0].normal[axis]) == 0) ++axis;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
        const Facet<N>& f = facets[side];
        const Facet<N>& g = facets[1 - side];
        const int inner = numbers.sign(f.normal[axis]);
        for (std::size_t e = 0; e < 3; ++e) {
            const Lengths<N>& from = f.corners[e];
            const Lengths<N> along = minus(f.corners[(e + 1) % 3], from);
            int nearest = -1;
            for (const Lengths<N>& p : g.corners) {
                const Lengths<N> to = minus(p, from);
                const auto left = N::minor(along[u], to[v], along[v], to[u]);
                nearest = std::max(nearest, inner * numbers.sign(left));
            }
            if (nearest < 0) return Overlap::None;
            if (nearest == 0) out = Overlap::Outlines;
        }
    }
    return out;
}

// An edge from p to q goes through the plane of normal n and value v at v(p) / (v(p) - v(q)) of its
// length. A shift s of the plane takes n·s from v(p), one of the edge adds it, and either leaves
// the difference as it is. Growth about c takes -v(c) and adds v(p) - v(c); of the sums below, the
// part with v(p) is 0.
template <class N>
int order_along(const LatticePoint& from, const LatticePoint& to, bool is_second,
                const FacetCorners& one, const FacetCorners& other,
                const InfinitesimalShift& shift) {
    const std::array<Facet<N>, 2> facets{Facet<N>(one), Facet<N>(other)};
    const Lengths<N> p = lengths<N>(from);
    const Lengths<N> q = lengths<N>(to);
    using Value = typename N::Value;
    std::array<Value, 2> start;
    std::array<Value, 2> drop;
    for (std::size_t i = 0; i < 2; ++i) {
        start[i] = facets[i].value(p);
        drop[i] = start[i] - facets[i].value(q);
    }
    const int drops = drop[0].sign() * drop[1].sign();
    const auto ahead = [&](const std::array<Value, 2>& v) {
        return (N::product(v[0], drop[1]) - N::product(v[1], drop[0])).sign();
    };
    if (const int sign = ahead(start); sign != 0) return sign * drops;
    int moved = 0;
    if (shift.growth != 0) {
        const Lengths<N> centre = lengths<N>(shift.centre);
        moved = -shift.growth * ahead({facets[0].value(centre), facets[1].value(centre)});
    }
    if (moved == 0) {
        std::array<int, 3> signs;
        for (std::size_t k = 0; k < 3; ++k)
            signs[k] = (N::product(facets[0].normal[k], drop[1]) -
                        N::product(facets[1].normal[k], drop[0]))
                           .sign();
        moved = shift.along(signs);
    }
    return (is_second ? moved : -moved) * drops;
}

// The line goes through the facet where it passes all of its edges on one side. With d = q - p the
// sign for an edge from a to b is that of det(d, b - a, a - p); its derivative is d × (b - a),
// along what moves the edge or against what moves the line.
template <class N>
std::optional<int> passage(const LatticePoint& from, const LatticePoint& to, bool is_second,
                           const FacetCorners& corners, const InfinitesimalShift& shift) {
    const Facet<N> facet(corners);
    const N numbers;
    const Derivatives<N> derivatives(numbers, shift);
    const Lengths<N> p = lengths<N>(from);
    const Lengths<N> q = lengths<N>(to);
    const auto side = [&](const Lengths<N>& at) {
        const int sign = facet.value(at).sign();
        const int moved = sign != 0 ? 0 : derivatives.of_value(facet);
        return sign != 0 ? sign : (is_second ? moved : -moved);
    };
    const int start = side(p);
    if (start == side(q)) return 0;
    const Lengths<N> d = minus(q, p);
    for (std::size_t e = 0; e < 3; ++e) {
        const Lengths<N>& a = facet.corners[e];
        const Normal<N> n = cross<N>(d, minus(facet.corners[(e + 1) % 3], a));
        int sign = dot<N>(n, minus(a, p)).sign();
        if (sign == 0)
            sign = is_second ? -derivatives.of_product(n, p) : derivatives.of_product(n, a);
        if (sign == 0) return std::nullopt;
        if (sign != start) return 0;
    }
    return -start;
}

bool is_whole(const InfinitesimalShift& shift) {
    return (shift.growth == 0 || shift.centre.is_whole()) &&
           (shift.next_growth == 0 || shift.next_centre.is_whole());
}

// By what doubles say, or integers where they leave a sign open.
template <class Answer>
auto in_numbers(bool whole, const Answer& answer) {
    const NearNumbers near;
    auto out = answer(near);
    if (!near.is_open()) return out;
    return whole ? answer(WholeNumbers()) : answer(Fractions());
}

}  // namespace

std::optional<ShiftedPair> relate_in_doubles(const FacetCorners& first, const FacetCorners& second,
                                             const InfinitesimalShift& shift) {
    const NearNumbers near;
    ShiftedPair out = relate(near, first, second, shift);
    if (near.is_open()) return std::nullopt;
    return out;
}

ShiftedPair relate_exactly(const FacetCorners& first, const FacetCorners& second,
                           const InfinitesimalShift& shift) {
    return are_whole({&first, &second}) && is_whole(shift)
               ? relate(WholeNumbers(), first, second, shift)
               : relate(Fractions(), first, second, shift);
}

ShiftedPair relate_shifted(const FacetCorners& first, const FacetCorners& second,
                           const InfinitesimalShift& shift) {
    if (const auto known = relate_in_doubles(first, second, shift)) return *known;
    return relate_exactly(first, second, shift);
}

Overlap coplanar_overlap(const FacetCorners& first, const FacetCorners& second) {
    return in_numbers(are_whole({&first, &second}),
                      [&](const auto& n) { return overlap(n, first, second); });
}

std::array<int, 3> normal_signs(const FacetCorners& facet) {
    return in_numbers(are_whole({&facet}),
                      [&]<class N>(const N& n) { return signs_of(n, Facet<N>(facet).normal); });
}

int side_of_shifted(const FacetCorners& facet, const InfinitesimalShift& shift) {
    return in_numbers(are_whole({&facet}) && is_whole(shift), [&]<class N>(const N& n) {
        return Derivatives<N>(n, shift).of_value(Facet<N>(facet));
    });
}

int side_of_shifted(const FacetCorners& first, const FacetCorners& second,
                    const InfinitesimalShift& shift) {
    if (shift.moves == nullptr) return side_of_shifted(first, shift);
    return in_numbers(are_whole({&first, &second}), [&]<class N>(const N& n) {
        const CornerDerivatives<N> derivatives(n, shift, second);
        const Facet<N> plane(first);
        const int sign = derivatives.of_corner(plane, 0);
        return sign == derivatives.of_corner(plane, 1) && sign == derivatives.of_corner(plane, 2)
                   ? sign
                   : 0;
    });
}

std::optional<int> passage_shifted(const LatticePoint& from, const LatticePoint& to, bool is_second,
                                   const FacetCorners& facet, const InfinitesimalShift& shift) {
    if (shift.moves != nullptr)
        return are_whole({&facet}) && from.is_whole() && to.is_whole()
                   ? passage_moved<WholeNumbers>(from, to, is_second, facet, shift)
                   : passage_moved<Fractions>(from, to, is_second, facet, shift);
    return are_whole({&facet}) && from.is_whole() && to.is_whole() && is_whole(shift)
               ? passage<WholeNumbers>(from, to, is_second, facet, shift)
               : passage<Fractions>(from, to, is_second, facet, shift);
}

int order_along_shifted(const LatticePoint& from, const LatticePoint& to, bool is_second,
                        const FacetCorners& one, const FacetCorners& other,
                        const InfinitesimalShift& shift) {
    if (shift.moves != nullptr)
        if (const auto known = OrderAtCorner(from, to, is_second, shift).of({one, other}))
            return *known;
    const bool whole =
        are_whole({&one, &other}) && from.is_whole() && to.is_whole() && is_whole(shift);
    if (shift.moves != nullptr)
        return whole ? order_along_moved<WholeNumbers>(from, to, is_second, {one, other}, shift)
                     : order_along_moved<Fractions>(from, to, is_second, {one, other}, shift);
    return whole ? order_along<WholeNumbers>(from, to, is_second, one, other, shift)
                 : order_along<Fractions>(from, to, is_second, one, other, shift);
}

}  // namespace trisect::detail
