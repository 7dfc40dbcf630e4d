// SPDX-License-Identifier: Apache-2.0
//
// Widths of the exact stage. Narrow planes have |n_i| < 2^54, |d| < 2^81; all planes have
// |n_i| < 2^109, |d| < 2^163 (plane.h). With Hadamard's bound for 3×3 determinants:
//
//                 w = det(n,n,n)      x = det(n,n,d)            n·x + d·w
//   narrow        3√3·2^162 < 2^165   3√3·2^(108+81) < 2^192    < 2^248   -> 3, 4 and 4 limbs
//   all           3√3·2^327 < 2^330   3√3·2^(218+163) < 2^384   < 2^496   -> 6, 7 and 8 limbs
//
// Bernstein and Fussell (2009) introduced predicates on planes alone; keeping the homogeneous point
// follows Nehring-Wirxel, Trettner, Kobbelt (2021), sec. 3; the tighter bound on det4 (4096 V^9
// instead of their general one) is the product of the entries above for coordinates below V.

#include <trisect/kernel/predicates.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>

namespace trisect {

PredicateCounters& predicate_counters() noexcept {
    thread_local PredicateCounters counters;
    return counters;
}

namespace {

// Register widths of one tier, in limbs.
struct Narrow {
    static constexpr int normal = 1, offset = 2, cross = 2, w = 3, xyz = 4, side = 4;
};
struct Wide {
    static constexpr int normal = 2, offset = 3, cross = 4, w = 6, xyz = 7, side = 8;
};

template <class T>
using Normal = std::array<WideInt<T::normal>, 3>;

template <class T>
Normal<T> normal_of(const Plane& p) {
    return {WideInt<T::normal>(p.normal(0)), WideInt<T::normal>(p.normal(1)),
            WideInt<T::normal>(p.normal(2))};
}

template <class T>
using Cross = std::array<WideInt<T::cross>, 3>;

template <class T>
Cross<T> cross(const Normal<T>& a, const Normal<T>& b) {
    constexpr int c = T::cross;
    return {multiply<c>(a[1], b[2]) - multiply<c>(a[2], b[1]),
            multiply<c>(a[2], b[0]) - multiply<c>(a[0], b[2]),
            multiply<c>(a[0], b[1]) - multiply<c>(a[1], b[0])};
}

template <class T>
struct TierPoint {
    std::array<WideInt<T::xyz>, 3> xyz;
    WideInt<T::w> w;
};

// Cramer's rule in the form  point = -(d_p q×r + d_q r×p + d_r p×q) / (p · q×r).
template <class T>
TierPoint<T> cramer(const Plane& p, const Plane& q, const Plane& r) {
    const auto np = normal_of<T>(p);
    const auto nq = normal_of<T>(q);
    const auto nr = normal_of<T>(r);
    const auto qr = cross<T>(nq, nr);
    const auto rp = cross<T>(nr, np);
    const auto pq = cross<T>(np, nq);
    const WideInt<T::offset> dp(p.offset());
    const WideInt<T::offset> dq(q.offset());
    const WideInt<T::offset> dr(r.offset());
    TierPoint<T> out;
    out.w = multiply<T::w>(qr[0], np[0]) + multiply<T::w>(qr[1], np[1]) +
            multiply<T::w>(qr[2], np[2]);
    const bool negate = !out.w.is_negative();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto sum = multiply<T::xyz>(qr[i], dp) + multiply<T::xyz>(rp[i], dq) +
                         multiply<T::xyz>(pq[i], dr);
        out.xyz[i] = negate ? -sum : sum;
    }
    if (!negate) out.w = -out.w;
    return out;
}

template <class T>
int sign_at(const TierPoint<T>& x, const Plane& s) {
    const auto n = normal_of<T>(s);
    WideInt<T::side> sum = multiply<T::side>(x.w, WideInt<T::offset>(s.offset()));
    for (std::size_t i = 0; i < 3; ++i) sum += multiply<T::side>(x.xyz[i], n[i]);
    return sum.sign();
}

bool all_narrow(const Plane& p, const Plane& q, const Plane& r) {
    return p.is_narrow() && q.is_narrow() && r.is_narrow();
}

// Forward error of Cramer's rule in doubles. u = 2^-53. Coefficients carry one rounding each; an
// entry of a cross product is then within 5u of the sum of the magnitudes of its two products, a
// term of w or x (one more product, two more sums) within 10u of the sum of magnitudes of all
// products. 16u covers the second-order terms and the rounding of the magnitudes.
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

constexpr double relative_bound = 0x1p-49;  // 16 u

}  // namespace

std::optional<HomogeneousPoint> intersect(const Plane& p, const Plane& q, const Plane& r) {
    HomogeneousPoint out;
    if (all_narrow(p, q, r)) {
        const auto t = cramer<Narrow>(p, q, r);
        if (t.w.is_zero()) return std::nullopt;
        for (std::size_t i = 0; i < 3; ++i) out.xyz[i] = WideInt<7>(t.xyz[i]);
        out.w = WideInt<6>(t.w);
        return out;
    }
    const auto t = cramer<Wide>(p, q, r);
    if (t.w.is_zero()) return std::nullopt;
    out.xyz = t.xyz;
    out.w = t.w;
    return out;
}

int sign_of_det(const Plane& a, const Plane& b, const Plane& c) {
    // Filter: the same bound as for w in double_cramer.
    double w = 0;
    double magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int l = (i + 2) % 3;
        const double s = b.approx_normal(j) * c.approx_normal(l);
        const double t = b.approx_normal(l) * c.approx_normal(j);
        w += a.approx_normal(i) * (s - t);
        magnitude += std::fabs(a.approx_normal(i)) * (std::fabs(s) + std::fabs(t));
    }
    auto& counters = predicate_counters();
    if (std::fabs(w) > relative_bound * magnitude) {
        ++counters.filtered;
        return w > 0 ? 1 : -1;
    }
    if (all_narrow(a, b, c)) {
        ++counters.exact_narrow;
        const auto x = cross<Narrow>(normal_of<Narrow>(b), normal_of<Narrow>(c));
        const auto n = normal_of<Narrow>(a);
        return (multiply<3>(x[0], n[0]) + multiply<3>(x[1], n[1]) + multiply<3>(x[2], n[2])).sign();
    }
    ++counters.exact_wide;
    const auto x = cross<Wide>(normal_of<Wide>(b), normal_of<Wide>(c));
    const auto n = normal_of<Wide>(a);
    return (multiply<6>(x[0], n[0]) + multiply<6>(x[1], n[1]) + multiply<6>(x[2], n[2])).sign();
}

bool meet_in_a_point(const Plane& p, const Plane& q, const Plane& r) {
    return sign_of_det(p, q, r) != 0;
}

Approximation approximate(const LatticePoint& p) {
    return {{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}, 0.0};
}

Approximation approximate(const HomogeneousPoint& p) {
    Approximation a;
    a.c = nearest_doubles(p);
    double largest = 0;
    for (double c : a.c) largest = std::max(largest, std::fabs(c));
    a.error = largest * 0x1p-53;  // half a unit in the last place of the largest coordinate
    return a;
}

Approximation approximate(const Plane& p, const Plane& q, const Plane& r) {
    const DoubleCramer d = double_cramer(p, q, r);
    const double w_error = relative_bound * d.w_magnitude;
    const double w_safe = std::fabs(d.w) - w_error;
    // Below a quarter the quotient's own error would not be linear any more.
    if (w_safe > 0.75 * std::fabs(d.w)) {
        Approximation a;
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            a.c[i] = d.x[i] / d.w;
            // |X/W - x/w| <= (δx + |x/w| δw) / (|w| - δw), plus the division's own rounding.
            const double c = std::fabs(a.c[i]);
            const double e =
                (relative_bound * d.magnitude[i] + c * w_error) / w_safe * 1.0001 + c * 0x1p-52;
            a.error = std::max(a.error, e);
            largest = std::max(largest, c);
        }
        if (a.error <= 0x1p-40 * largest) return a;
    }
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "approximating a point of planes that do not meet in one");
    return approximate(*exact);
}

double nearest_double(const WideInt<7>& numerator, const WideInt<6>& denominator) {
    if (numerator.is_zero()) return 0;
    const bool negative = numerator.is_negative();
    // Scale so that the integer quotient has at least 66 bits, compute it by restoring division bit
    // by bit on 54 bits: exact, and this function is not on a hot path.
    using W = WideInt<16>;
    const W n(numerator.abs());
    const W d(denominator);
    // 2^(e-1) < n/d < 2^(e+1)
    int e = n.bit_length() - d.bit_length();
    // mantissa m in [2^52, 2^53): n/d = m · 2^(s), s = e - 52 or one less.
    const auto scaled = [&](int s) {  // compare-ready pair n·2^max(-s,0), d·2^max(s,0)
        return std::pair<W, W>{s < 0 ? n.shifted_left(-s) : n, s > 0 ? d.shifted_left(s) : d};
    };
    {
        const auto [a, b] = scaled(e);
        if (a < b) --e;  // now 2^e <= n/d < 2^(e+1)
    }
    auto [a, b] = scaled(e - 52);
    // a / b in [2^52, 2^53): restoring division.
    std::uint64_t m = 0;
    for (int bit = 52; bit >= 0; --bit) {
        const W t = b.shifted_left(bit);
        if (a >= t) {
            a -= t;
            m |= std::uint64_t{1} << bit;
        }
    }
    const W twice = a + a;
    if (twice > b || (twice == b && (m & 1U) != 0)) ++m;
    const double r = std::ldexp(static_cast<double>(m), e - 52);
    return negative ? -r : r;
}

std::array<double, 3> nearest_doubles(const HomogeneousPoint& p) {
    return {nearest_double(p.xyz[0], p.w), nearest_double(p.xyz[1], p.w),
            nearest_double(p.xyz[2], p.w)};
}

Side side_of(const LatticePoint& point, const Plane& plane) {
    auto& counters = predicate_counters();
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
        sum += multiply<3>(WideInt<2>(plane.normal(i)), WideInt<1>(point[i]));
    return side_from_sign(sum.sign());
}

Side side_of(const HomogeneousPoint& point, const Plane& plane) {
    ++predicate_counters().exact_wide;
    return side_from_sign(sign_at(TierPoint<Wide>{point.xyz, point.w}, plane));
}

Side side_of(const Approximation& approximation, const Plane& p, const Plane& q, const Plane& r,
             const Plane& plane) {
    auto& counters = predicate_counters();
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
    const double s = a.approx_normal(j) * b.approx_normal(l);
    const double t = a.approx_normal(l) * b.approx_normal(j);
    auto& counters = predicate_counters();
    if (std::fabs(s - t) > 0x1p-50 * (std::fabs(s) + std::fabs(t))) {
        ++counters.filtered;
        return s > t ? 1 : -1;
    }
    ++counters.exact_wide;
    const auto left = multiply<4>(WideInt<2>(a.normal(j)), WideInt<2>(b.normal(l)));
    const auto right = multiply<4>(WideInt<2>(a.normal(l)), WideInt<2>(b.normal(j)));
    return (left - right).sign();
}

int sign_of_dot(const Plane& a, const Plane& b) {
    WideInt<4> sum;
    for (int i = 0; i < 3; ++i)
        sum += multiply<4>(WideInt<2>(a.normal(i)), WideInt<2>(b.normal(i)));
    return sum.sign();
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
