// SPDX-License-Identifier: Apache-2.0
//
// Widths of the exact stage. Narrow planes have |n_i| < 2^56, |d| < 2^83; all planes have
// |n_i| < 2^109, |d| < 2^163 (plane.h). With Hadamard's bound for determinants, 3√3 = 5.2 times the
// product of the largest entries for 3×3, 16 times for 4×4:
//
//             w = det(n,n,n)       x = det(n,n,d)             n·x + d·w = det(n,n,n,d)
//   narrow    3√3·2^168 < 2^171    3√3·2^(112+83) < 2^198     16·2^(168+83) = 2^255
//   all       3√3·2^327 < 2^330    3√3·2^(218+163) < 2^384    16·2^(327+163) = 2^494
//   digits    3 and 6              4 and 7                    4 and 8 columns
//
// N digits (kernel/number/digits.h) hold 56 (N-1) + 62 bits. The columns of a sum are formed
// exactly whatever its terms: they hold at most 21 products below 2^118 each.
//
// Bernstein and Fussell (2009) introduced predicates on planes alone; keeping the homogeneous point
// follows Nehring-Wirxel, Trettner, Kobbelt (2021), sec. 3; the tighter bound on det4 (4096 V^9
// instead of their general one) is the product of the entries above for coordinates below V.

#include <trisect/kernel/predicates.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/digits.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/filters.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

using detail::add_product;
using detail::carried;
using detail::Columns;
using detail::determinant_rounding;
using detail::Digits;
using detail::negate_if;
using detail::sign_of;
using detail::subtract_product;
using detail::to_digits;
using detail::to_wide_int;

namespace {

// Widths of one tier in digits of 56 bits; the top digit may have 62 bits.
struct Narrow {
    static constexpr int normal = 1, offset = 2, cross = 2, w = 3, xyz = 4;
};
struct Wide {
    static constexpr int normal = 2, offset = 3, cross = 4, w = 6, xyz = 7;
};

template <class T>
using Normal = std::array<Digits<T::normal>, 3>;

template <class T>
using Cross = std::array<Digits<T::cross>, 3>;

template <class T>
Normal<T> normal_of(const Plane& p) {
    return {to_digits<T::normal>(p.normal(0)), to_digits<T::normal>(p.normal(1)),
            to_digits<T::normal>(p.normal(2))};
}

template <class T>
Cross<T> cross(const Normal<T>& a, const Normal<T>& b) {
    Cross<T> out;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t l = (i + 2) % 3;
        Columns<2 * T::normal - 1> minor;
        add_product(minor, a[j], b[l]);
        subtract_product(minor, a[l], b[j]);
        out[i] = carried<T::cross>(minor);
    }
    return out;
}

template <class T>
Columns<T::cross + T::normal - 1> det(const Normal<T>& a, const Cross<T>& b_cross_c) {
    Columns<T::cross + T::normal - 1> sum;
    for (std::size_t i = 0; i < 3; ++i) add_product(sum, b_cross_c[i], a[i]);
    return sum;
}

template <class T>
struct TierPoint {
    std::array<Digits<T::xyz>, 3> xyz;
    Digits<T::w> w;
    int sign_w = 0;  // before w was made positive
};

// Cramer's rule in the form  point = -(d_p q×r + d_q r×p + d_r p×q) / (p · q×r).
// Not inlined: its hundreds of products leave no register to a caller's values.
template <class T>
[[gnu::noinline]] TierPoint<T> cramer(const Plane& p, const Plane& q, const Plane& r) {
    const auto np = normal_of<T>(p);
    const auto nq = normal_of<T>(q);
    const auto nr = normal_of<T>(r);
    const auto qr = cross<T>(nq, nr);
    const auto rp = cross<T>(nr, np);
    const auto pq = cross<T>(np, nq);
    const auto dp = to_digits<T::offset>(p.offset());
    const auto dq = to_digits<T::offset>(q.offset());
    const auto dr = to_digits<T::offset>(r.offset());
    TierPoint<T> out;
    auto w = det<T>(np, qr);
    out.sign_w = sign_of(w);
    negate_if(w, out.sign_w < 0);
    out.w = carried<T::w>(w);
    for (std::size_t i = 0; i < 3; ++i) {
        Columns<T::cross + T::offset - 1> x;
        add_product(x, qr[i], dp);
        add_product(x, rp[i], dq);
        add_product(x, pq[i], dr);
        negate_if(x, out.sign_w > 0);
        out.xyz[i] = carried<T::xyz>(x);
    }
    return out;
}

template <class T>
HomogeneousPoint homogeneous(const TierPoint<T>& x) {
    return {{to_wide_int<7>(x.xyz[0]), to_wide_int<7>(x.xyz[1]), to_wide_int<7>(x.xyz[2])},
            to_wide_int<6>(x.w)};
}

template <class T>
int sign_at(const TierPoint<T>& x, const Plane& s) {
    const auto n = normal_of<T>(s);
    Columns<T::xyz + T::normal - 1> sum;
    for (std::size_t i = 0; i < 3; ++i) add_product(sum, x.xyz[i], n[i]);
    add_product(sum, x.w, to_digits<T::offset>(s.offset()));
    return sign_of(sum);
}

template <class T>
TierPoint<T> tier_point(const HomogeneousPoint& p) {
    return {{to_digits<T::xyz>(p.xyz[0]), to_digits<T::xyz>(p.xyz[1]), to_digits<T::xyz>(p.xyz[2])},
            to_digits<T::w>(p.w),
            1};
}

// Whether the digits of the narrow tier hold the point: |x| < 2^229 (of 230), w < 2^173 (of 174).
bool fits_narrow(const HomogeneousPoint& p) {
    bool fits =
        p.w.limb(2) < (std::uint64_t{1} << 45) && (p.w.limb(3) | p.w.limb(4) | p.w.limb(5)) == 0;
    constexpr std::uint64_t half = std::uint64_t{1} << 37;
    for (const auto& x : p.xyz) {
        const std::uint64_t sign = x.is_negative() ? ~std::uint64_t{0} : 0;
        const std::uint64_t above = (x.limb(4) ^ sign) | (x.limb(5) ^ sign) | (x.limb(6) ^ sign);
        fits = fits && above == 0 && x.limb(3) + half < 2 * half;
    }
    return fits;
}

template <class T>
int sign_of_cross(const Plane& a, const Plane& b, int j, int l) {
    Columns<2 * T::normal - 1> minor;
    add_product(minor, to_digits<T::normal>(a.normal(j)), to_digits<T::normal>(b.normal(l)));
    subtract_product(minor, to_digits<T::normal>(a.normal(l)), to_digits<T::normal>(b.normal(j)));
    return sign_of(minor);
}

template <class T>
int sign_of_dot(const Plane& a, const Plane& b) {
    Columns<2 * T::normal - 1> sum;
    for (int i = 0; i < 3; ++i)
        add_product(sum, to_digits<T::normal>(a.normal(i)), to_digits<T::normal>(b.normal(i)));
    return sign_of(sum);
}

std::array<double, 3> approx_normal(const Plane& p) {
    return {p.approx_normal(0), p.approx_normal(1), p.approx_normal(2)};
}

bool all_narrow(const Plane& p, const Plane& q, const Plane& r) {
    return p.is_narrow() && q.is_narrow() && r.is_narrow();
}

// Cramer's rule in doubles, off by less than determinant_rounding of the magnitudes.
struct DoubleCramer {
    std::array<double, 3> x{};
    std::array<double, 3> magnitude{};
    double w = 0;
    double w_magnitude = 0;
};

DoubleCramer double_cramer(const Plane& p, const Plane& q, const Plane& r) {
    DoubleCramer out;
    const std::array<const Plane*, 3> planes{&p, &q, &r};
    for (int k = 0; k < 3; ++k) {
        const Plane& a = *planes[static_cast<std::size_t>((k + 1) % 3)];
        const Plane& b = *planes[static_cast<std::size_t>((k + 2) % 3)];
        const Plane& c = *planes[static_cast<std::size_t>(k)];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int l = (i + 2) % 3;
            const double s = a.approx_normal(j) * b.approx_normal(l);
            const double t = a.approx_normal(l) * b.approx_normal(j);
            const double minor = s - t;
            const double minor_magnitude = std::fabs(s) + std::fabs(t);
            const auto ii = static_cast<std::size_t>(i);
            out.x[ii] -= c.approx_offset() * minor;
            out.magnitude[ii] += std::fabs(c.approx_offset()) * minor_magnitude;
            if (k == 0) {
                out.w += c.approx_normal(i) * minor;
                out.w_magnitude += std::fabs(c.approx_normal(i)) * minor_magnitude;
            }
        }
    }
    return out;
}

// The quotients x / w, each with a bound of its error, when that is known well enough.
struct Quotients {
    std::array<double, 3> c{};
    std::array<double, 3> error{};
};

std::optional<Quotients> quotients(const DoubleCramer& d) {
    const double w_error = determinant_rounding * d.w_magnitude;
    const double w_safe = std::fabs(d.w) - w_error;
    // Below a quarter the quotient's own error would not be linear any more.
    if (!(w_safe > 0.75 * std::fabs(d.w))) return std::nullopt;
    Quotients out;
    for (std::size_t i = 0; i < 3; ++i) {
        out.c[i] = d.x[i] / d.w;
        // |X/W - x/w| <= (δx + |x/w| δw) / (|w| - δw), plus the division's own rounding.
        const double c = std::fabs(out.c[i]);
        out.error[i] =
            (determinant_rounding * d.magnitude[i] + c * w_error) / w_safe * detail::bound_slack +
            c * detail::last_place;
    }
    return out;
}

}  // namespace

std::optional<HomogeneousPoint> intersect(const Plane& p, const Plane& q, const Plane& r) {
    if (all_narrow(p, q, r)) {
        const auto t = cramer<Narrow>(p, q, r);
        if (t.sign_w == 0) return std::nullopt;
        return homogeneous(t);
    }
    const auto t = cramer<Wide>(p, q, r);
    if (t.sign_w == 0) return std::nullopt;
    return homogeneous(t);
}

int sign_of_det(const Plane& a, const Plane& b, const Plane& c) {
    const int filtered =
        detail::filter_det(approx_normal(a), approx_normal(b), approx_normal(c)).sign();
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (filtered != 0) {
        ++counters.filtered;
        return filtered;
    }
    if (all_narrow(a, b, c)) {
        ++counters.exact_narrow;
        return sign_of(det<Narrow>(normal_of<Narrow>(a),
                                   cross<Narrow>(normal_of<Narrow>(b), normal_of<Narrow>(c))));
    }
    ++counters.exact_wide;
    return sign_of(
        det<Wide>(normal_of<Wide>(a), cross<Wide>(normal_of<Wide>(b), normal_of<Wide>(c))));
}

bool meet_in_a_point(const Plane& p, const Plane& q, const Plane& r) {
    return sign_of_det(p, q, r) != 0;
}

HomogeneousPoint homogeneous(const LatticePoint& p) {
    const auto x = detail::to_integers(p);
    return {{WideInt<7>(x[0]), WideInt<7>(x[1]), WideInt<7>(x[2])}, WideInt<6>(1)};
}

Approximation approximate(const LatticePoint& p) { return {p.doubles(), 0.0}; }

Approximation approximate(const HomogeneousPoint& p) {
    Approximation a;
    a.c = nearest_doubles(p);
    double largest = 0;
    for (double c : a.c) largest = std::max(largest, std::fabs(c));
    a.error =
        largest * detail::unit_roundoff;  // half a unit in the last place of the largest coordinate
    return a;
}

Approximation approximate(const Plane& p, const Plane& q, const Plane& r) {
    const auto x = quotients(double_cramer(p, q, r));
    if (x) {
        Approximation a;
        a.c = x->c;
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            a.error = std::max(a.error, x->error[i]);
            largest = std::max(largest, std::fabs(a.c[i]));
        }
        if (a.error <= 0x1p-40 * largest) return a;
    }
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "approximating a point of planes that do not meet in one");
    return approximate(*exact);
}

Side side_of(const LatticePoint& point, const Plane& plane) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (const auto s = filtered_side(approximate(point), plane)) {
        ++counters.filtered;
        return *s;
    }
    if (plane.is_narrow()) {
        ++counters.exact_narrow;
    } else {
        ++counters.exact_wide;
    }
    Plane::Offset sum = plane.offset();
    for (int i = 0; i < 3; ++i)
        sum += multiply<3>(WideInt<2>(plane.normal(i)), WideInt<1>(point[i].to_integer()));
    return side_from_sign(sum.sign());
}

Side side_of(const HomogeneousPoint& point, const Plane& plane) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (plane.is_narrow() && fits_narrow(point)) {
        ++counters.exact_narrow;
        return side_from_sign(sign_at(tier_point<Narrow>(point), plane));
    }
    ++counters.exact_wide;
    return side_from_sign(sign_at(tier_point<Wide>(point), plane));
}

Side side_of(const Approximation& approximation, const Plane& p, const Plane& q, const Plane& r,
             const Plane& plane) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (const auto s = filtered_side(approximation, plane)) {
        ++counters.filtered;
        return *s;
    }
    if (plane == p || plane == q || plane == r) {
        ++counters.symbolic;
        return Side::On;
    }
    if (plane.is_narrow() && all_narrow(p, q, r)) {
        ++counters.exact_narrow;
        return side_from_sign(sign_at(cramer<Narrow>(p, q, r), plane));
    }
    ++counters.exact_wide;
    return side_from_sign(sign_at(cramer<Wide>(p, q, r), plane));
}

std::strong_ordering compare_coordinate(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                        int axis) {
    const auto i = static_cast<std::size_t>(axis);
    // 384 + 330 bits; both denominators are positive.
    return multiply<13>(a.xyz[i], b.w) <=> multiply<13>(b.xyz[i], a.w);
}

int sign_of_cross(const Plane& a, const Plane& b, int axis) {
    const int j = (axis + 1) % 3;
    const int l = (axis + 2) % 3;
    const auto filtered = detail::filter_cross(a.approx_normal(j), a.approx_normal(l),
                                               b.approx_normal(j), b.approx_normal(l));
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    // The bound is 0 where both products are, and then they are exactly 0: they are of integers.
    if (filtered.sign() != 0 || filtered.bound == 0) {
        ++counters.filtered;
        return filtered.sign();
    }
    if (a.is_narrow() && b.is_narrow()) {
        ++counters.exact_narrow;
        return sign_of_cross<Narrow>(a, b, j, l);
    }
    ++counters.exact_wide;
    return sign_of_cross<Wide>(a, b, j, l);
}

int sign_of_dot(const Plane& a, const Plane& b) {
    const int filtered = detail::filter_dot(approx_normal(a), approx_normal(b)).sign();
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (filtered != 0) {
        ++counters.filtered;
        return filtered;
    }
    if (a.is_narrow() && b.is_narrow()) {
        ++counters.exact_narrow;
        return sign_of_dot<Narrow>(a, b);
    }
    ++counters.exact_wide;
    return sign_of_dot<Wide>(a, b);
}

bool is_same_plane(const Plane& a, const Plane& b) {
    for (int i = 0; i < 3; ++i)
        if (sign_of_cross(a, b, i) != 0) return false;
    // Parallel normals: compare offsets scaled by the other's normal along the dominant axis.
    const int k = a.dominant_axis();
    return multiply<5>(a.offset(), WideInt<2>(b.normal(k))) ==
           multiply<5>(b.offset(), WideInt<2>(a.normal(k)));
}

bool same_orientation(const Plane& a, const Plane& b) { return sign_of_dot(a, b) > 0; }

}  // namespace trisect
