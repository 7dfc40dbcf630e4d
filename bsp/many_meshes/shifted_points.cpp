// SPDX-License-Identifier: Apache-2.0
//
// A vertex is a corner, a point of an edge in a plane, or a point of three planes; what is asked is
// on which side of one more plane it lies. With n · (y - x) for the plane of normal n through x:
//
// - a corner p: the plane's value at p, which is linear in what moves p and what moves x;
// - of an edge from p to q in a plane k, with v for values and D = v(p) - v(q): the sign of
//   v(p) D_k - v_k(p) D, by that of D_k. A D does not change when its plane or the edge is moved;
// - of three planes: a determinant of four planes, by that of the three normals, linear in how far
//   each plane is from the origin.
//
// So every answer is the sign of a number, or where that is 0 the sign of a sum of one derivative
// for each operand, each times an infinitesimal of its own: the largest of them that is not 0
// decides. The derivative by the plane that is asked about is never 0. An operand that grows keeps
// the directions of its edges and planes, and its points x go along x - c; common positive factors
// aside, all is as linear as for moves.
//
// Orders along a line are sides as well: of the plane that ends one way with respect to the other.
//
// Doubles with errors that keep certain zeros come first: what touches is mostly across an axis.
// Integers decide what these leave open. Derivatives are made from the largest move on.

#include <trisect/bsp/many_meshes/shifted_points.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <trisect/bsp/many_meshes/near_number.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace shifted {

namespace {

// What both kinds of integers have in common.
struct Exact {
    template <class Integer>
    [[nodiscard]] static int sign(const Integer& v) {
        return v.sign();
    }
    static constexpr bool is_open() { return false; }
};

// Whole coordinates: lengths are below 2^54, components of normals below 2^109, of their products
// below 2^219, values of planes below 2^165, products of three normals below 2^330, of these and a
// value below 2^497; derivatives, times a length, below 2^500.
struct WholeNumbers : Exact {
    static constexpr int fraction = 0;
    using Length = WideInt<1>;
    using Area = WideInt<2>;
    using Minor = WideInt<4>;
    using Value = WideInt<3>;
    using Volume = WideInt<6>;
    using Sum = WideInt<8>;
    using Approximate = WideInt<7>;  // a value times a minor, below 2^386
    static Length length(Coordinate c) { return {c.to_integer()}; }
};

// In units of 2^-fraction_limit: lengths are below 2^127, components of normals below 2^255, of
// their products below 2^511, values below 2^383, products of three normals below 2^768, of these
// and a value below 2^1154; derivatives, times a length, below 2^1155.
struct Fractions : Exact {
    static constexpr int fraction = fraction_limit;
    using Length = WideInt<2>;
    using Area = WideInt<4>;
    using Minor = WideInt<8>;
    using Value = WideInt<6>;
    using Volume = WideInt<13>;
    using Sum = WideInt<19>;
    using Approximate = WideInt<15>;
    static Length length(Coordinate c) { return {scaled_integer(c, fraction_limit)}; }
};

template <class To, int A, int B>
To product(const WideInt<A>& a, const WideInt<B>& b) {
    return []<int R>(const WideInt<R>*, const auto& u, const auto& v) { return multiply<R>(u, v); }(
               static_cast<const To*>(nullptr), a, b);
}

template <class To>
To product(const NearNumber& a, const NearNumber& b) {
    return a * b;
}

template <class T>
using Three = std::array<T, 3>;

template <class T>
Three<T> minus(const Three<T>& a, const Three<T>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class To, class T>
Three<To> cross(const Three<T>& u, const Three<T>& v) {
    Three<To> n{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        n[k] = product<To>(u[i], v[j]) - product<To>(u[j], v[i]);
    }
    return n;
}

template <class To, class T, class U>
To dot(const Three<T>& u, const Three<U>& v) {
    To sum;
    for (std::size_t k = 0; k < 3; ++k) sum += product<To>(u[k], v[k]);
    return sum;
}

template <class To, class T, class U>
Three<To> times(const T& factor, const Three<U>& v) {
    Three<To> out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = product<To>(factor, v[k]);
    return out;
}

template <class N>
using Point = Three<typename N::Length>;

template <class N>
Point<N> point_of(const LatticePoint& p) {
    return {N::length(p.x), N::length(p.y), N::length(p.z)};
}

template <class N>
struct ShiftedPlane {
    Three<typename N::Area> normal{};
    Point<N> at{};
    std::uint32_t slot = 0;

    [[nodiscard]] typename N::Value value(const Point<N>& p) const {
        return dot<typename N::Value>(normal, minus(p, at));
    }
};

template <class N>
struct ShiftedEdge {
    Point<N> from{};
    Point<N> to{};
    std::uint32_t slot = 0;
};

// Derivatives of a number by the moves of a few operands. They are looked at from the largest move
// on, and mostly the first one decides.
template <class N>
class Derivatives {
public:
    using Sum = typename N::Sum;

    Derivatives(const N& numbers, const OperandShifts& shifts)
        : numbers_(numbers), shifts_(shifts) {}

    // Moves of that operand along v add their product with `by`; points move from `at`.
    void add(std::uint32_t slot, const Three<Sum>& by, const Point<N>& at) {
        terms_[count_++] = {slot, by, at};
    }
    // Of the sum of all, which is not 0.
    [[nodiscard]] int sign() const {
        if (shifts_.do_grow()) {
            const int s = first_sign([&](std::uint32_t slot) { return shifts_.growth_rank(slot); },
                                     [&](std::uint32_t slot) {
                                         const auto& growth = shifts_.growth(slot);
                                         const Point<N> centre = point_of<N>(growth.centre);
                                         Sum sum{};
                                         for_each_term(slot, [&](const Term& t) {
                                             sum += dot<Sum>(t.by, minus(t.at, centre));
                                         });
                                         return growth.sign * numbers_.sign(sum);
                                     });
            if (s != 0 || numbers_.is_open()) return s;
        }
        for (const std::uint8_t axis : shifts_.axes()) {
            const int s =
                first_sign([&](std::uint32_t slot) { return shifts_.rank(axis, slot); },
                           [&](std::uint32_t slot) {
                               Sum sum{};
                               for_each_term(slot, [&](const Term& t) { sum += t.by[axis]; });
                               return numbers_.sign(sum);
                           });
            if (s != 0 || numbers_.is_open()) return s;
        }
        return 0;
    }

private:
    struct Term {
        std::uint32_t slot = 0;
        Three<Sum> by{};
        Point<N> at{};
    };
    template <class Visit>
    void for_each_term(std::uint32_t slot, const Visit& visit) const {
        for (std::size_t i = 0; i < count_; ++i)
            if (terms_[i].slot == slot) visit(terms_[i]);
    }
    // The sign that is not 0 of the first in rank.
    template <class Rank, class Sign>
    [[nodiscard]] int first_sign(const Rank& rank, const Sign& sign) const {
        std::array<std::pair<std::uint32_t, std::uint32_t>, most> slots;
        for (std::size_t i = 0; i < count_; ++i) slots[i] = {rank(terms_[i].slot), terms_[i].slot};
        std::sort(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(count_));
        for (std::size_t i = 0; i < count_; ++i) {
            if (i > 0 && slots[i] == slots[i - 1]) continue;
            if (const int s = sign(slots[i].second); s != 0 || numbers_.is_open()) return s;
        }
        return 0;
    }

    static constexpr std::size_t most = 4;
    const N& numbers_;
    const OperandShifts& shifts_;
    std::array<Term, most> terms_;
    std::size_t count_ = 0;
};

// Signs, and whether one needed the moves.
template <class N>
class ShiftedSides {
public:
    ShiftedSides(const N& numbers, const ManyMeshes& meshes) : numbers_(numbers), meshes_(meshes) {}

    [[nodiscard]] bool needed_moves() const { return needed_moves_; }

    [[nodiscard]] ShiftedPlane<N> plane(std::uint32_t facet) const {
        const std::uint32_t slot = meshes_.slot_of(facet);
        const Point<N> a = corner(slot, facet, 0);
        const Point<N> b = corner(slot, facet, 1);
        const Point<N> c = corner(slot, facet, 2);
        return {cross<typename N::Area>(minus(b, a), minus(c, a)), a, slot};
    }
    [[nodiscard]] ShiftedEdge<N> edge(std::uint32_t facet, int edge) const {
        const std::uint32_t slot = meshes_.slot_of(facet);
        return {corner(slot, facet, edge), corner(slot, facet, edge == 2 ? 0 : edge + 1), slot};
    }
    // Across an axis, through a corner.
    [[nodiscard]] ShiftedPlane<N> across(std::size_t axis, const OutlineVertex& vertex) const {
        const std::uint32_t slot = meshes_.slot_of(vertex.facets[0]);
        ShiftedPlane<N> out;
        out.normal[axis] = typename N::Area(1);
        out.at = corner(slot, vertex.facets[0], vertex.which);
        out.slot = slot;
        return out;
    }

    [[nodiscard]] int side_of(const OutlineVertex& v, const ShiftedPlane<N>& plane) {
        switch (v.kind) {
            case OutlineVertex::Kind::Corner: {
                const std::uint32_t slot = meshes_.slot_of(v.facets[0]);
                return side_of_point(corner(slot, v.facets[0], v.which), slot, plane);
            }
            case OutlineVertex::Kind::Pierce:
                return side_on_edge(edge(v.facets[0], v.which), this->plane(v.facets[1]), plane);
            case OutlineVertex::Kind::Meeting:
                break;
        }
        return side_of_meeting(this->plane(v.facets[0]), this->plane(v.facets[1]),
                               this->plane(v.facets[2]), plane);
    }

    [[nodiscard]] int side_of_point(const Point<N>& p, std::uint32_t slot,
                                    const ShiftedPlane<N>& plane) {
        if (const int s = numbers_.sign(plane.value(p)); s != 0 || numbers_.is_open()) return s;
        Derivatives<N> d = moves();
        d.add(slot, times<Sum>(typename N::Length(1), plane.normal), p);
        d.add(plane.slot, times<Sum>(typename N::Length(-1), plane.normal), plane.at);
        return d.sign();
    }

    // Of the point of the edge in the first plane with respect to the second one.
    [[nodiscard]] int side_on_edge(const ShiftedEdge<N>& e, const ShiftedPlane<N>& in,
                                   const ShiftedPlane<N>& plane) {
        const auto start = plane.value(e.from);
        const auto start_in = in.value(e.from);
        const auto drop = start - plane.value(e.to);
        const auto drop_in = start_in - in.value(e.to);
        const int way = numbers_.sign(drop_in);
        const int s = numbers_.sign(product<Sum>(start, drop_in) - product<Sum>(start_in, drop));
        if (s != 0 || numbers_.is_open()) return s * way;
        Derivatives<N> d = moves();
        const auto of_plane = times<Sum>(drop_in, plane.normal);
        const auto of_in = times<Sum>(drop, in.normal);
        const Three<Sum> zero{};
        d.add(e.slot, minus(of_plane, of_in), e.from);
        d.add(plane.slot, minus(zero, of_plane), plane.at);
        d.add(in.slot, of_in, in.at);
        return d.sign() * way;
    }

    [[nodiscard]] int side_of_meeting(const ShiftedPlane<N>& a, const ShiftedPlane<N>& b,
                                      const ShiftedPlane<N>& c, const ShiftedPlane<N>& plane) {
        const auto by_a = volume(plane, b, c);
        const auto by_b = volume(plane, c, a);
        const auto by_c = volume(plane, a, b);
        const auto all = volume(a, b, c);
        const int way = numbers_.sign(all);
        // How far planes are from the point of one of them.
        const auto height = [&](const ShiftedPlane<N>& p) {
            return dot<typename N::Value>(p.normal, minus(p.at, plane.at));
        };
        const int s = numbers_.sign(product<Sum>(by_a, height(a)) + product<Sum>(by_b, height(b)) +
                                    product<Sum>(by_c, height(c)));
        if (s != 0 || numbers_.is_open()) return s * way;
        Derivatives<N> d = moves();
        const Three<Sum> zero{};
        d.add(a.slot, times<Sum>(by_a, a.normal), a.at);
        d.add(b.slot, times<Sum>(by_b, b.normal), b.at);
        d.add(c.slot, times<Sum>(by_c, c.normal), c.at);
        d.add(plane.slot, minus(zero, times<Sum>(all, plane.normal)), plane.at);
        return d.sign() * way;
    }

    [[nodiscard]] typename N::Volume volume(const ShiftedPlane<N>& a, const ShiftedPlane<N>& b,
                                            const ShiftedPlane<N>& c) const {
        return dot<typename N::Volume>(cross<typename N::Minor>(a.normal, b.normal), c.normal);
    }
    [[nodiscard]] int drop_along(const ShiftedEdge<N>& e, const ShiftedPlane<N>& plane) const {
        return numbers_.sign(plane.value(e.from) - plane.value(e.to));
    }
    // Of the direction of the line of two planes through a third one.
    [[nodiscard]] int rise_along(const ShiftedPlane<N>& a, const ShiftedPlane<N>& b,
                                 const ShiftedPlane<N>& plane) const {
        return numbers_.sign(volume(a, b, plane));
    }
    [[nodiscard]] int slope(const ShiftedPlane<N>& plane, std::size_t axis) const {
        return numbers_.sign(plane.normal[axis]);
    }

    [[nodiscard]] Approximation meeting(const ShiftedPlane<N>& a, const ShiftedPlane<N>& b,
                                        const ShiftedPlane<N>& c) const {
        using Minor = typename N::Minor;
        const auto from_b = cross<Minor>(c.normal, a.normal);
        const auto from_c = cross<Minor>(a.normal, b.normal);
        const double all = volume(a, b, c).to_double();
        const auto height = [&](const ShiftedPlane<N>& p) {
            return dot<typename N::Value>(p.normal, minus(p.at, a.at));
        };
        const auto of_b = height(b);
        const auto of_c = height(c);
        Approximation out;
        for (std::size_t k = 0; k < 3; ++k) {
            const double step = (product<typename N::Approximate>(from_b[k], of_b) +
                                 product<typename N::Approximate>(from_c[k], of_c))
                                    .to_double() /
                                all;
            const double way = std::ldexp(step, -N::fraction);
            const double from = std::ldexp(a.at[k].to_double(), -N::fraction);
            out.c[k] = from + way;
            out.error = std::max(out.error, 0x1p-49 * (std::fabs(from) + std::fabs(way)));
        }
        return out;
    }

    [[nodiscard]] ShiftedPoints::Direction direction(const ShiftedPlane<N>& a,
                                                     const ShiftedPlane<N>& b) const {
        const auto n = cross<typename N::Minor>(a.normal, b.normal);
        ShiftedPoints::Direction out;
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = std::fabs(n[k].to_double());
            if (length <= longest) continue;
            longest = length;
            out = {k, numbers_.sign(n[k])};
        }
        return out;
    }

private:
    using Sum = typename N::Sum;
    [[nodiscard]] Derivatives<N> moves() {
        needed_moves_ = true;
        return {numbers_, *meshes_.shifts};
    }
    [[nodiscard]] Point<N> corner(std::uint32_t slot, std::uint32_t facet, int i) const {
        const std::uint32_t own = facet - meshes_.operands->operands[slot].first;
        return point_of<N>(meshes_.sources[slot]->corner(own, i));
    }

    const N& numbers_;
    const ManyMeshes& meshes_;
    bool needed_moves_ = false;
};

bool are_whole(const ManyMeshes& meshes, std::initializer_list<std::uint32_t> facets) {
    return std::ranges::all_of(
        facets, [&](std::uint32_t f) { return meshes.sources[meshes.slot_of(f)]->is_whole(); });
}

bool is_whole(const ManyMeshes& meshes, const OutlineVertex& v) {
    switch (v.kind) {
        case OutlineVertex::Kind::Corner:
            return are_whole(meshes, {v.facets[0]});
        case OutlineVertex::Kind::Pierce:
            return are_whole(meshes, {v.facets[0], v.facets[1]});
        case OutlineVertex::Kind::Meeting:
            break;
    }
    return are_whole(meshes, {v.facets[0], v.facets[1], v.facets[2]});
}

template <class N, class Answer>
auto with_numbers_of(const ManyMeshes& meshes, const Answer& answer) {
    const N numbers;
    ShiftedSides<N> sides(numbers, meshes);
    return answer(sides);
}

// With the numbers that the operands take.
template <class Answer>
auto with_integers(const ManyMeshes& meshes, bool whole, const Answer& answer) {
    return whole ? with_numbers_of<WholeNumbers>(meshes, answer)
                 : with_numbers_of<Fractions>(meshes, answer);
}

// In doubles, or in integers where these leave a sign open. An answer has no effects.
template <class Answer>
auto with_numbers(const ManyMeshes& meshes, bool whole, const Answer& answer) {
    const NearNumbersOfShifts near;
    ShiftedSides<NearNumbersOfShifts> sides(near, meshes);
    auto out = answer(sides);
    return near.is_open() ? with_integers(meshes, whole, answer) : out;
}

}  // namespace

}  // namespace shifted

using shifted::are_whole;
using shifted::is_whole;
using shifted::with_integers;
using shifted::with_numbers;

void ShiftedPoints::note(std::initializer_list<std::uint32_t> facets) const {
    for (const std::uint32_t f : facets) special_.note(f);
}

void ShiftedPoints::note_side(const OutlineVertex& vertex, std::uint32_t own,
                              std::uint32_t facet) const {
    note({own, facet, vertex.facets[0]});
    if (vertex.kind != OutlineVertex::Kind::Corner) note({vertex.facets[1]});
    if (vertex.kind == OutlineVertex::Kind::Meeting) note({vertex.facets[2]});
}

ShiftedPoints::Side ShiftedPoints::side(const OutlineVertex& vertex, std::uint32_t facet) const {
    if (const int side = side_of_plane(vertex, facet); side != 0) return {side, true};
    return with_numbers(meshes_, is_whole(meshes_, vertex) && are_whole(meshes_, {facet}),
                        [&](auto& sides) -> Side {
                            const int side = sides.side_of(vertex, sides.plane(facet));
                            return {side, sides.needed_moves()};
                        });
}

// Of a vertex in the plane of a facet across an axis, because it is a point of another facet there:
// both are moved along the axis, each with its operand, whatever else meets in the vertex. 0 where
// that is not so.
int ShiftedPoints::side_of_plane(const OutlineVertex& vertex, std::uint32_t facet) const {
    const PlanesAcrossAxes::Plane& plane = meshes_.planes.of(facet);
    if (plane.way == 0) return 0;
    const std::size_t count = vertex.kind == OutlineVertex::Kind::Corner   ? 1
                              : vertex.kind == OutlineVertex::Kind::Pierce ? 2
                                                                           : 3;
    std::size_t i = 0;
    while (i < count && !meshes_.planes.are_same(vertex.facets[i], facet)) ++i;
    if (i == count) return 0;
    const std::uint32_t slot = meshes_.slot_of(vertex.facets[i]);
    const std::uint32_t other = meshes_.slot_of(facet);
    if (slot == other) return 0;
    const int axis = plane.axis;
    const OperandShifts& shifts = *meshes_.shifts;
    if (shifts.do_grow()) {
        const Coordinate at = (*meshes_.lattice_corners(facet)[0])[axis];
        const auto growth = [&](std::uint32_t s) {
            const OperandShifts::Growth& g = shifts.growth(s);
            const Coordinate centre = g.centre[axis];
            return g.sign * (at > centre ? 1 : (at < centre ? -1 : 0));
        };
        const std::array<int, 2> up{growth(slot), -growth(other)};
        const std::size_t first = shifts.growth_rank(slot) < shifts.growth_rank(other) ? 0 : 1;
        const int sign = up[first] != 0 ? up[first] : up[1 - first];
        if (sign != 0) return plane.way * sign;
    }
    const auto k = static_cast<std::size_t>(axis);
    return plane.way * (shifts.rank(k, slot) < shifts.rank(k, other) ? 1 : -1);
}

// The point in the plane of the first one is below or above the other one's; the edge falls or
// rises through that.
int ShiftedPoints::order_on_edge(std::uint32_t facet, std::int8_t edge, std::uint32_t one,
                                 std::uint32_t other) const {
    const Side order =
        with_numbers(meshes_, are_whole(meshes_, {facet, one, other}), [&](auto& sides) -> Side {
            const auto e = sides.edge(facet, edge);
            const auto plane = sides.plane(other);
            const int side = sides.side_on_edge(e, sides.plane(one), plane);
            return {-side * sides.drop_along(e, plane), sides.needed_moves()};
        });
    if (order.by_moves) note({facet, one, other});
    return order.sign;
}

int ShiftedPoints::order_on_line(const std::array<std::uint32_t, 2>& line, std::uint32_t one,
                                 std::uint32_t other) const {
    const Side order = with_numbers(
        meshes_, are_whole(meshes_, {line[0], line[1], one, other}), [&](auto& sides) -> Side {
            const auto a = sides.plane(line[0]);
            const auto b = sides.plane(line[1]);
            const auto plane = sides.plane(other);
            const int side = sides.side_of_meeting(a, b, sides.plane(one), plane);
            return {side * sides.rise_along(a, b, plane), sides.needed_moves()};
        });
    if (order.by_moves) note({line[0], line[1], one, other});
    return order.sign;
}

int ShiftedPoints::order_to_end(const FacetCrossing& crossing, std::size_t end,
                                std::uint32_t facet) const {
    const Side order =
        with_numbers(meshes_, are_whole(meshes_, {crossing.facets[0], crossing.facets[1], facet}),
                     [&](auto& sides) -> Side {
                         const auto a = sides.plane(crossing.facets[0]);
                         const auto b = sides.plane(crossing.facets[1]);
                         const auto plane = sides.plane(facet);
                         const FacetCrossing::End& e = crossing.ends[end];
                         const auto edge = sides.edge(crossing.facets[e.of_second ? 1 : 0], e.edge);
                         const int side = sides.side_on_edge(edge, e.of_second ? a : b, plane);
                         return {-side * sides.rise_along(a, b, plane), sides.needed_moves()};
                     });
    if (order.by_moves) note({crossing.facets[0], crossing.facets[1], facet});
    return order.sign;
}

Approximation ShiftedPoints::meeting(const std::array<std::uint32_t, 3>& facets) const {
    return with_integers(meshes_, are_whole(meshes_, {facets[0], facets[1], facets[2]}),
                         [&](auto& sides) {
                             return sides.meeting(sides.plane(facets[0]), sides.plane(facets[1]),
                                                  sides.plane(facets[2]));
                         });
}

ShiftedPoints::Direction ShiftedPoints::direction(std::uint32_t first, std::uint32_t second) const {
    return with_numbers(meshes_, are_whole(meshes_, {first, second}), [&](auto& sides) {
        return sides.direction(sides.plane(first), sides.plane(second));
    });
}

int ShiftedPoints::order_along(const OutlineVertex& vertex, const OutlineVertex& corner,
                               std::size_t axis) const {
    return with_numbers(
        meshes_, is_whole(meshes_, vertex) && is_whole(meshes_, corner),
        [&](auto& sides) { return sides.side_of(vertex, sides.across(axis, corner)); });
}

int ShiftedPoints::order_at_height(const OutlinedSolid& solid, std::uint32_t facet,
                                   const OutlinedSolid::Edge& edge, const OutlineVertex& corner,
                                   const std::array<std::size_t, 2>& axes) const {
    const FacetCrossing* line = solid.line_of(edge);
    const bool whole = is_whole(meshes_, corner) &&
                       (line == nullptr ? are_whole(meshes_, {facet})
                                        : are_whole(meshes_, {line->facets[0], line->facets[1]}));
    return with_numbers(meshes_, whole, [&](auto& sides) {
        const auto plane = sides.across(axes[0], corner);
        const auto at_height = sides.across(axes[1], corner);
        if (line == nullptr)
            return sides.side_on_edge(sides.edge(facet, edge.origin.own()), at_height, plane);
        return sides.side_of_meeting(sides.plane(line->facets[0]), sides.plane(line->facets[1]),
                                     at_height, plane);
    });
}

int ShiftedPoints::slope(std::uint32_t facet, std::size_t axis) const {
    return with_numbers(meshes_, are_whole(meshes_, {facet}),
                        [&](auto& sides) { return sides.slope(sides.plane(facet), axis); });
}

int ShiftedPoints::side_of_corner(const OutlineVertex& corner, std::uint32_t facet) const {
    return with_numbers(meshes_, is_whole(meshes_, corner) && are_whole(meshes_, {facet}),
                        [&](auto& sides) { return sides.side_of(corner, sides.plane(facet)); });
}

}  // namespace trisect::detail
