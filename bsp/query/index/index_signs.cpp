// SPDX-License-Identifier: Apache-2.0
//
// For a triangle a, b, c everything is a determinant of three differences:
//
//   s(x) = N · (x - a), N = (b - a) × (c - a)          side of x
//   e(a, b) = det(r - p, a - p, b - p)                  on which side of a→b the line p r passes
//
// The segment from r to p meets the triangle's interior when s(r) and s(p) differ in sign and the
// three e agree. Signs come from doubles first, with the bound of error_bounds.h
// (difference_determinant_rounding). An error of the point itself moves the determinant by at most
// 6 L^2 of it.
//
// When doubles cannot decide, every one of these determinants is linear in p: n · (p - x) with a
// normal n made of lattice points and the reference alone, of at most 2^126 for whole coordinates.
// So the exact stage is one dot product: in 128 bits when p has few bits, which is the common case
// for points that lie exactly on something, in 576 bits for what a HomogeneousPoint holds, in
// rationals otherwise. Where corners have bits behind the point, n and x are those of a Plane; but
// whether a double is on a triangle is decided in integers of a fixed width, too.

#include <trisect/bsp/query/index/index_signs.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <trisect/bsp/query/index/line_through.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using WideNormal = std::array<Int128, 3>;
using FineVector = std::array<std::int64_t, 3>;

int bit_length(Int128 v) {
    const Uint128 m =
        v < 0 ? static_cast<Uint128>(0) - static_cast<Uint128>(v) : static_cast<Uint128>(v);
    const auto high = static_cast<std::uint64_t>(m >> 64);
    return high != 0 ? 128 - std::countl_zero(high)
                     : 64 - std::countl_zero(static_cast<std::uint64_t>(m));
}
int bit_length(const WideNormal& n) {
    return std::max({bit_length(n[0]), bit_length(n[1]), bit_length(n[2])});
}

// The sign of n · (scale p - base). \pre |n| < 2^126, |base| < 2^63, scale is 1 or splitting_scale.
int sign_linear(const IndexPoint& p, const WideNormal& n, const FineVector& base,
                std::int64_t scale) {
    if (const auto& small = p.small()) {
        // |c| < 2^62: c scale and base 2^62 fit 128 bits.
        std::array<Int128, 3> x{};
        int bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = Int128{small->c[k]} * scale - (Int128{base[k]} << small->bits);
            bits = std::max(bits, bit_length(x[k]));
        }
        if (bit_length(n) + bits <= 125) {
            ++detail::counters_of_thread<PredicateCounters>.exact_narrow;
            const Int128 sum = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
            return sum > 0 ? 1 : (sum < 0 ? -1 : 0);
        }
    }
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    if (const HomogeneousPoint* h = p.homogeneous(); h != nullptr && h->is_short()) {
        WideInt<9> sum;
        for (std::size_t k = 0; k < 3; ++k) {
            const WideInt<8> x = multiply<8>(WideInt<7>(h->xyz[k]), WideInt<1>(scale)) -
                                 multiply<8>(WideInt<6>(h->w), WideInt<1>(base[k]));
            sum += multiply<9>(x, WideInt<2>(n[k]));
        }
        return sum.sign();
    }
    ExactRational sum;
    for (std::size_t k = 0; k < 3; ++k)
        sum += ExactRational(WideInt<2>(n[k])) *
               (p.rational()[k] * ExactRational(scale) - ExactRational(base[k]));
    return sum.sign();
}

// The corners of a source's facet, and whether all of that source are whole.
struct IndexTriangle {
    const LatticePoint& a;
    const LatticePoint& b;
    const LatticePoint& c;
    bool whole = true;
};

FineVector fine_coordinates(const LatticePoint& p) {
    return {fine_position(p.x), fine_position(p.y), fine_position(p.z)};
}

WideNormal exact_cross(const FineVector& u, const FineVector& v) {
    const auto minor = [&](std::size_t j, std::size_t l) {
        return Int128{u[j]} * v[l] - Int128{u[l]} * v[j];
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

WideNormal whole_normal(const IndexTriangle& t) {
    return exact_cross(minus(to_integers(t.b), to_integers(t.a)),
                       minus(to_integers(t.c), to_integers(t.a)));
}

int exact_side(const IndexPoint& p, const IndexTriangle& t) {
    if (!t.whole) return p.side_of(Plane::through(t.a, t.b, t.c));
    return sign_linear(p, whole_normal(t), to_integers(t.a), 1);
}

// Component k of (a - p) × (b - p): which way p, a, b turn seen along axis k.
int exact_turn(const IndexPoint& p, const LatticePoint& a, const LatticePoint& b, bool whole,
               std::size_t k) {
    const std::size_t j = (k + 1) % 3;
    const std::size_t l = (k + 2) % 3;
    if (!whole) {
        if (coordinate(a, j) == coordinate(b, j) && coordinate(a, l) == coordinate(b, l)) return 0;
        return -p.side_of(Plane::along_axis(a, b, static_cast<int>(k)));
    }
    const FineVector e = minus(to_integers(b), to_integers(a));
    WideNormal n{};  // (p - a)_l e_j - (p - a)_j e_l
    n[l] = e[j];
    n[j] = -Int128{e[l]};
    return sign_linear(p, n, to_integers(a), 1);
}

IndexPoint::Rational exact_point(const LatticePoint& p) {
    return {ExactRational::from_double(p.x.to_double()),
            ExactRational::from_double(p.y.to_double()),
            ExactRational::from_double(p.z.to_double())};
}

// det(r - p, a - p, b - p) of corners with bits behind the point: below 0 for p above the plane
// through r, a and b.
int side_of_fractions(const IndexPoint& p, const Reference& r, const LatticePoint& a,
                      const LatticePoint& b) {
    if (r.error == 0) {
        const LatticePoint known{Coordinate(r.c[0]), Coordinate(r.c[1]), Coordinate(r.c[2])};
        return are_collinear(known, a, b) ? 0 : -p.side_of(Plane::through(known, a, b));
    }
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    IndexPoint::Rational from;
    for (std::size_t k = 0; k < 3; ++k)
        from[k] = ExactRational(r.fine.c[k]) / ExactRational(splitting_scale);
    const auto n = cross(minus(exact_point(a), from), minus(exact_point(b), from));
    return dot(n, minus(from, p.rational())).sign();
}

int side_of_whole(const IndexPoint& p, const FinePoint& r, const LatticePoint& a,
                  const LatticePoint& b) {
    WideNormal n = exact_cross(minus(fine_coordinates(a), r.c), minus(fine_coordinates(b), r.c));
    for (Int128& x : n) x = -x;
    return sign_linear(p, n, r.c, splitting_scale);
}

// det(r - p, a - p, b - p) for the moved reference: never 0 where a, b and p are not on one line.
int exact_passing_side(const IndexPoint& p, const Reference& r, const LatticePoint& a,
                       const LatticePoint& b, bool whole) {
    if (const int s = whole ? side_of_whole(p, r.fine, a, b) : side_of_fractions(p, r, a, b);
        s != 0)
        return s;
    ++detail::counters_of_thread<PredicateCounters>.symbolic;
    for (std::size_t k = 0; k < 3; ++k)
        if (const int s = exact_turn(p, a, b, whole, k); s != 0) return s;
    return 0;
}

// 384 + 8 bits, and 328 + 61.
WideInt<7> exact_value(const FinePoint& r, const Plane& plane) {
    WideInt<7> sum = multiply<7>(plane.offset(), WideInt<1>(splitting_scale));
    for (int k = 0; k < 3; ++k)
        sum += multiply<7>(plane.normal(k), WideInt<1>(r.c[static_cast<std::size_t>(k)]));
    return sum;
}

int first_sign(const Plane& plane) {
    for (int k = 0; k < 3; ++k)
        if (plane.normal(k) != 0) return plane.normal(k) > 0 ? 1 : -1;
    return 0;
}

int exact_reference_side(const FinePoint& r, const Plane& plane) {
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    const int s = exact_value(r, plane).sign();
    return s != 0 ? s : first_sign(plane);
}

int exact_reference_side(const FinePoint& r, const IndexTriangle& t) {
    if (!t.whole) return exact_reference_side(r, Plane::through(t.a, t.b, t.c));
    const WideNormal n = whole_normal(t);
    const FineVector d = minus(r.c, fine_coordinates(t.a));
    ++detail::counters_of_thread<PredicateCounters>.exact_narrow;
    WideInt<4> sum;  // 109 + 63 + 2 bits
    for (std::size_t k = 0; k < 3; ++k) sum += multiply<4>(WideInt<2>(n[k]), WideInt<1>(d[k]));
    if (const int s = sum.sign(); s != 0) return s;
    for (const Int128 x : n)
        if (x != 0) return sign(x);
    return 0;
}

// The axis in which a triangle's normal is largest, and the normal's sign there.
struct Facing {
    std::size_t axis = 0;
    int turn = 0;
};

Facing facing(const IndexTriangle& t) {
    if (!t.whole) {
        const Plane plane = Plane::through(t.a, t.b, t.c);
        const int axis = plane.dominant_axis();
        return {static_cast<std::size_t>(axis), plane.normal(axis).sign()};
    }
    const WideNormal n = whole_normal(t);
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (bit_length(n[i]) > bit_length(n[k])) k = i;
    return {k, sign(n[k])};
}

bool is_outside_box(const IndexPoint& p, const IndexTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<int>(i);
        const double lo = std::min({t.a[axis], t.b[axis], t.c[axis]}).to_double();
        const double hi = std::max({t.a[axis], t.b[axis], t.c[axis]}).to_double();
        if (p[i] + p.error() < lo || p[i] - p.error() > hi) return true;
    }
    return false;
}

// For a point in the plane of the triangle.
bool is_in_triangle(const IndexPoint& p, const IndexTriangle& t) {
    if (is_outside_box(p, t)) return false;  // most are
    const auto [k, turn] = facing(t);
    const auto is_left = [&, k = k, turn = turn](const LatticePoint& a, const LatticePoint& b) {
        return exact_turn(p, a, b, t.whole, k) * turn >= 0;
    };
    return is_left(t.a, t.b) && is_left(t.b, t.c) && is_left(t.c, t.a);
}

// Whether a point is on a triangle, in integers of two words where these are enough; nothing
// otherwise. `normal`: in doubles, from edges that differ from the exact ones by rounding.
std::optional<bool> is_on_narrow(const IndexPoint& p, const IndexTriangle& t,
                                 const Vector3& normal) {
    const auto& small = p.small();
    if (!small) return std::nullopt;
    const auto bits = static_cast<unsigned>(small->bits);
    const std::array<const LatticePoint*, 3> corner{&t.a, &t.b, &t.c};
    std::array<FineVector, 3> edge;
    std::array<FineVector, 3> way;  // to the point, in its finest bits
    double longest_edge = 0;
    double longest_way = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const LatticePoint& from = *corner[i];
        const LatticePoint& to = *corner[(i + 1) % 3];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<int>(k);
            const double start = from[axis].to_double();
            edge[i][k] = difference(to[axis], from[axis]);
            longest_edge = std::max(longest_edge, std::fabs(to[axis].to_double() - start));
            longest_way = std::max(longest_way, std::fabs(p[k] - start));
            // What overflows on the way comes back.
            way[i][k] = static_cast<std::int64_t>(
                static_cast<std::uint64_t>(small->c[k]) -
                (static_cast<std::uint64_t>(from[axis].to_integer()) << bits));
        }
    }
    longest_way *= static_cast<double>(std::uint64_t{1} << bits);
    const double longest_normal = largest_component(normal) + 0x1p-40 * longest_edge * longest_edge;
    if (!(longest_way < 0x1p61) || !(longest_normal * longest_way < 0x1p124)) return std::nullopt;
    ++detail::counters_of_thread<PredicateCounters>.exact_narrow;
    const WideNormal n = exact_cross(edge[0], edge[1]);
    if (n[0] * way[0][0] + n[1] * way[0][1] + n[2] * way[0][2] != 0) return false;
    // Seen along the axis in which the normal is largest.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(normal[i]) > std::fabs(normal[k])) k = i;
    if (n[k] == 0) return std::nullopt;
    detail::counters_of_thread<PredicateCounters>.exact_narrow += 3;
    const std::size_t j = (k + 1) % 3;
    const std::size_t l = (k + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
        const Int128 turn = Int128{edge[i][j]} * way[i][l] - Int128{edge[i][l]} * way[i][j];
        if (n[k] < 0 ? turn > 0 : turn < 0) return false;
    }
    return true;
}

// The same for corners with bits behind the point. In their finest unit edges are below 2^127 and
// the normal below 2^255; a way in the finest one of all is below 2^(55 + way_bits).
std::optional<bool> is_on_fractions(const IndexPoint& p, const IndexTriangle& t) {
    constexpr int way_bits = 120;
    if (!p.is_doubles() || !(largest_component(p.approximate()) < 0x1p54)) return std::nullopt;
    if (is_outside_box(p, t)) return false;
    const int bits = std::max({fraction_bits(t.a), fraction_bits(t.b), fraction_bits(t.c)});
    int finest = bits;
    for (const double x : p.approximate()) finest = std::max(finest, -dyadic(x).exponent);
    if (finest > way_bits) return std::nullopt;
    detail::counters_of_thread<PredicateCounters>.exact_wide += 4;
    const std::array<const LatticePoint*, 3> corner{&t.a, &t.b, &t.c};
    std::array<VectorOf<WideInt<2>>, 3> at;
    std::array<VectorOf<WideInt<3>>, 3> way;  // to the point
    for (std::size_t k = 0; k < 3; ++k) {
        const Dyadic d = dyadic(p[k]);
        const WideInt<3> to = WideInt<3>(d.mantissa).shifted_left(d.exponent + finest);
        for (std::size_t i = 0; i < 3; ++i) {
            at[i][k] = scaled_integer(coordinate(*corner[i], k), bits);
            way[i][k] = to - WideInt<3>(at[i][k]).shifted_left(finest - bits);
        }
    }
    std::array<VectorOf<WideInt<2>>, 3> edge;
    for (std::size_t i = 0; i < 3; ++i) edge[i] = minus(at[(i + 1) % 3], at[i]);
    VectorOf<WideInt<4>> n;
    WideInt<7> value;
    std::size_t widest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t j = (k + 1) % 3;
        const std::size_t l = (k + 2) % 3;
        n[k] = multiply<4>(edge[0][j], edge[1][l]) - multiply<4>(edge[0][l], edge[1][j]);
        value += multiply<7>(n[k], way[0][k]);
        if (n[k].abs() > n[widest].abs()) widest = k;
    }
    if (!value.is_zero()) return false;
    const std::size_t j = (widest + 1) % 3;
    const std::size_t l = (widest + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
        const WideInt<5> turn =
            multiply<5>(edge[i][j], way[i][l]) - multiply<5>(edge[i][l], way[i][j]);
        if (turn.sign() * n[widest].sign() < 0) return false;
    }
    return true;
}

// Polygons that are no triangles ------------------------------------------------------------------

int filtered_sign(const Reference& r, const Plane& plane) {
    const auto s = filtered_side(Approximation{r.c, r.error}, plane);
    return s ? sign_of(*s) : 0;
}

int reference_side(const Reference& r, const Plane& plane) {
    if (const int s = filtered_sign(r, plane); s != 0) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return s;
    }
    return exact_reference_side(r.fine, plane);
}

// On which side of an edge the segment meets the support: with values s and e of the planes of
// support and edge at the two ends, e at the meeting point is (e_r s_p - e_p s_r) / (s_p - s_r).
int edge_side_exact(const IndexPoint& p, const Reference& r, const Plane& support,
                    const Plane& edge, int p_side) {
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    const auto& x = p.rational();
    const ExactRational s_p = value_at(x, support);
    const ExactRational e_p = value_at(x, edge);
    const ExactRational s_r(exact_value(r.fine, support));
    const ExactRational e_r(exact_value(r.fine, edge));
    // s_p - s_r has the sign of s_p.
    if (const int s = (e_r * s_p - e_p * s_r).sign(); s != 0) return s * p_side;
    for (int k = 0; k < 3; ++k) {
        const ExactRational moved =
            ExactRational(edge.normal(k)) * s_p - e_p * ExactRational(support.normal(k));
        if (const int s = moved.sign(); s != 0) return s * p_side;
    }
    return 0;
}

Passing passing_convex(const IndexPolygons& polygons, IndexPolygons::Id id, const IndexPoint& p,
                       const Reference& r) {
    const Plane support = polygons.support(id);
    const int p_side = p.side_of(support);
    if (p_side == 0) return is_on(polygons, id, p) ? Passing::On : Passing::None;
    if (reference_side(r, support) == p_side) return Passing::None;
    const LineThrough line = line_between(p, r);
    if (const int through = line.of(polygons.approximate_corners(id)); through != 0) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        if (through < 0) return Passing::None;
        return p_side < 0 ? Passing::Entering : Passing::Leaving;
    }
    for (const Plane& edge : polygons.edges(id)) {
        // Ends on one side of the edge decide without the meeting point.
        const auto a = filtered_side(p.approximation(), edge);
        const int b = filtered_sign(r, edge);
        if (a && b == sign_of(*a)) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            if (b > 0) return Passing::None;
            continue;
        }
        if (edge_side_exact(p, r, support, edge, p_side) > 0) return Passing::None;
    }
    return p_side < 0 ? Passing::Entering : Passing::Leaving;
}

Passing passing_triangle(const IndexTriangle& t, const IndexPoint& p, const Reference& r) {
    const Vector3 fa = t.a.doubles();
    const Vector3 fb = t.b.doubles();
    const Vector3 fc = t.c.doubles();
    const Vector3 u = minus(fb, fa);
    const Vector3 v = minus(fc, fa);
    const Vector3 n = cross(u, v);
    const double edge = std::max(largest_component(u), largest_component(v));
    auto& counters = detail::counters_of_thread<PredicateCounters>;

    const Vector3 w = minus(p.approximate(), fa);
    const double at_p = dot(n, w);
    const double p_bound =
        edge * edge * (difference_determinant_rounding * largest_component(w) + 8 * p.error());
    int p_side = 0;
    if (at_p > p_bound) {
        p_side = 1;
    } else if (at_p < -p_bound) {
        p_side = -1;
    } else {
        p_side = exact_side(p, t);
        if (p_side == 0) return is_in_triangle(p, t) ? Passing::On : Passing::None;
    }
    const Vector3 q = minus(r.c, fa);
    const double at_r = dot(n, q);
    const double r_bound =
        edge * edge * (difference_determinant_rounding * largest_component(q) + 8 * r.error);
    int r_side = 0;
    if (at_r > r_bound) {
        r_side = 1;
    } else if (at_r < -r_bound) {
        r_side = -1;
    } else {
        r_side = exact_reference_side(r.fine, t);
    }
    counters.filtered += 2;
    if (r_side == p_side) return Passing::None;

    const Vector3 d = minus(r.c, p.approximate());
    const Vector3 pa = minus(fa, p.approximate());
    const Vector3 pb = minus(fb, p.approximate());
    const Vector3 pc = minus(fc, p.approximate());
    const double m = std::max(std::max(largest_component(d), largest_component(pa)),
                              std::max(largest_component(pb), largest_component(pc)));
    const double bound = m * m * (difference_determinant_rounding * m + 18 * (p.error() + r.error));
    const std::array<double, 3> e{dot(d, cross(pa, pb)), dot(d, cross(pb, pc)),
                                  dot(d, cross(pc, pa))};
    const std::array<const LatticePoint*, 4> corner{&t.a, &t.b, &t.c, &t.a};
    counters.filtered += 3;
    // All three have the sign of their sum d · N, which is that of s(r) - s(p).
    for (std::size_t i = 0; i < 3; ++i) {
        if (e[i] * r_side > bound) continue;
        if (e[i] * r_side < -bound) return Passing::None;
        if (exact_passing_side(p, r, *corner[i], *corner[i + 1], t.whole) != r_side)
            return Passing::None;
    }
    return p_side < 0 ? Passing::Entering : Passing::Leaving;
}

IndexTriangle triangle(const IndexPolygons& polygons, IndexPolygons::Id id) {
    const Source& s = polygons.source(id);
    const std::uint32_t f = polygons.facet(id);
    return {s.corner(f, 0), s.corner(f, 1), s.corner(f, 2), s.is_whole()};
}

}  // namespace

LineThrough line_between(const IndexPoint& p, const Reference& r) {
    Vector3 way{};
    for (std::size_t k = 0; k < 3; ++k) way[k] = r.c[k] - p[k];
    return {p.approximate(), p.error(), way,
            p.error() + r.error + largest_component(way) * unit_roundoff};
}

Passing passing(const IndexPolygons& polygons, IndexPolygons::Id id, const IndexPoint& p,
                const Reference& r) {
    if (!polygons.is_triangle(id)) return passing_convex(polygons, id, p, r);
    return passing_triangle(triangle(polygons, id), p, r);
}

bool is_on(const IndexPolygons& polygons, IndexPolygons::Id id, const IndexPoint& p) {
    if (polygons.is_triangle(id)) {
        const IndexTriangle t = triangle(polygons, id);
        const Vector3 fa = t.a.doubles();
        if (p.is_doubles() && (p.approximate() == fa || p.approximate() == t.b.doubles() ||
                               p.approximate() == t.c.doubles())) {
            ++detail::counters_of_thread<PredicateCounters>.symbolic;
            return true;
        }
        const Vector3 u = minus(t.b.doubles(), fa);
        const Vector3 v = minus(t.c.doubles(), fa);
        const Vector3 w = minus(p.approximate(), fa);
        const double edge = std::max(largest_component(u), largest_component(v));
        const double bound =
            edge * edge * (difference_determinant_rounding * largest_component(w) + 8 * p.error());
        const Vector3 n = cross(u, v);
        if (std::fabs(dot(n, w)) > bound) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return false;
        }
        if (const auto on = t.whole ? is_on_narrow(p, t, n) : is_on_fractions(p, t)) return *on;
        return exact_side(p, t) == 0 && is_in_triangle(p, t);
    }
    if (p.side_of(polygons.support(id)) != 0) return false;
    for (const Plane& edge : polygons.edges(id))
        if (p.side_of(edge) > 0) return false;
    return true;
}

}  // namespace trisect::detail
