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
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/filters.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

using detail::add_product;
using detail::carried;
using detail::Columns;
using detail::determinant_rounding;
using detail::digit_bits;
using detail::Digits;
using detail::negate_if;
using detail::sign_of;
using detail::subtract_product;
using detail::to_digits;
using detail::to_wide_int;

namespace {

// Widths of the tiers in digits of 56 bits; the top digit may have 62 bits. With n and d bits of a
// normal and an offset (plane.cpp) a minor has 2 n + 1, w has 3 n + 3, xyz has 2 n + d + 4.
template <int Normal, int Offset, int Cross, int W, int Xyz>
struct Tier {
    static constexpr int normal = Normal, offset = Offset, cross = Cross, w = W, xyz = Xyz;
};
using Narrow = Tier<1, 2, 2, 3, 4>;    // 56 and 83 bits
using Wide = Tier<2, 3, 4, 6, 7>;      // 112 and 168: all that whole coordinates give
using Wide2 = Tier<3, 4, 7, 10, 11>;   // 174 and 230
using Wide3 = Tier<4, 5, 9, 13, 14>;   // 230 and 286
using Wide4 = Tier<6, 7, 12, 18, 19>;  // 328 and 384: all

constexpr int bits_of(int digits) { return digit_bits * (digits - 1) + 62; }

template <class T, int N, int D>
constexpr bool holds = bits_of(T::normal) >= N&& bits_of(T::offset) >= D&& bits_of(T::cross) >=
                           2 * N + 1 &&
                       bits_of(T::w) >= 3 * N + 3 && bits_of(T::xyz) >= 2 * N + D + 4;
static_assert(holds<Narrow, 56, 83> && holds<Wide, 112, 168> && holds<Wide2, 174, 230> &&
              holds<Wide3, 230, 286> && holds<Wide4, 328, 384>);

// Calls f with the tier of that number. Most are of the first two.
template <class F>
auto in_tier(int tier, F&& f) {
    if (tier == 0) return f(Narrow{});
    if (tier == 1) return f(Wide{});
    if (tier == 2) return f(Wide2{});
    return tier == 3 ? f(Wide3{}) : f(Wide4{});
}

template <class... P>
int tier_of(const P&... planes) {
    return std::max({planes.tier()...});
}

void count_exact(int tier) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    ++(tier == 0 ? counters.exact_narrow : counters.exact_wide);
}

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
HomogeneousPoint homogeneous(const TierPoint<T>& x, int tier) {
    HomogeneousPoint out;
    for (std::size_t i = 0; i < 3; ++i) out.xyz[i] = to_wide_int<17>(x.xyz[i]);
    out.w = to_wide_int<16>(x.w);
    out.tier = tier;
    return out;
}

template <class T>
int sign_at(const TierPoint<T>& x, const Plane& s) {
    const auto n = normal_of<T>(s);
    Columns<T::xyz + T::normal - 1> sum;
    for (std::size_t i = 0; i < 3; ++i) add_product(sum, x.xyz[i], n[i]);
    add_product(sum, x.w, to_digits<T::offset>(s.offset()));
    return sign_of(sum);
}

// Of coordinates with at most `bits` behind the point, which times 2^bits have so many digits.
template <class T, int Coordinate>
int sign_at_fractions(const LatticePoint& p, int bits, const Plane& s) {
    static_assert(bits_of(3) >= coordinate_bits + fraction_limit && bits_of(2) >= fraction_limit);
    Columns<std::max(T::normal + Coordinate, T::offset + 2) - 1> sum;
    for (int i = 0; i < 3; ++i)
        add_product(sum, to_digits<T::normal>(s.normal(i)),
                    to_digits<Coordinate>(detail::scaled_integer(p[i], bits)));
    add_product(sum, to_digits<T::offset>(s.offset()), to_digits<2>(Int128{1} << bits));
    return sign_of(sum);
}

template <class T>
TierPoint<T> tier_point(const HomogeneousPoint& p) {
    return {{to_digits<T::xyz>(p.xyz[0]), to_digits<T::xyz>(p.xyz[1]), to_digits<T::xyz>(p.xyz[2])},
            to_digits<T::w>(p.w),
            1};
}

template <class T>
constexpr bool has_room(int xyz_bits, int w_bits) {
    return xyz_bits <= bits_of(T::xyz) && w_bits <= bits_of(T::w);
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

HomogeneousPoint::HomogeneousPoint(const std::array<Coordinate, 3>& coordinates,
                                   const Weight& weight)
    : xyz(coordinates), w(weight) {
    const int bits = std::max({xyz[0].bit_length(), xyz[1].bit_length(), xyz[2].bit_length()});
    const int w_bits = w.bit_length();
    tier = has_room<Narrow>(bits, w_bits)  ? 0
           : has_room<Wide>(bits, w_bits)  ? 1
           : has_room<Wide2>(bits, w_bits) ? 2
           : has_room<Wide3>(bits, w_bits) ? 3
                                           : 4;
}

std::optional<HomogeneousPoint> intersect(const Plane& p, const Plane& q, const Plane& r) {
    const int tier = tier_of(p, q, r);
    return in_tier(tier, [&]<class T>(T) -> std::optional<HomogeneousPoint> {
        const auto t = cramer<T>(p, q, r);
        if (t.sign_w == 0) return std::nullopt;
        return homogeneous(t, tier);
    });
}

int sign_of_det(const Plane& a, const Plane& b, const Plane& c) {
    const int filtered =
        detail::filter_det(approx_normal(a), approx_normal(b), approx_normal(c)).sign();
    if (filtered != 0) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return filtered;
    }
    const int tier = tier_of(a, b, c);
    count_exact(tier);
    return in_tier(tier, [&]<class T>(T) {
        return sign_of(det<T>(normal_of<T>(a), cross<T>(normal_of<T>(b), normal_of<T>(c))));
    });
}

bool meet_in_a_point(const Plane& p, const Plane& q, const Plane& r) {
    return sign_of_det(p, q, r) != 0;
}

HomogeneousPoint homogeneous(const LatticePoint& p) {
    const int bits = detail::fraction_bits(p);
    HomogeneousPoint out;
    for (std::size_t k = 0; k < 3; ++k)
        out.xyz[k] = detail::scaled_integer(detail::coordinate(p, k), bits);
    out.w = HomogeneousPoint::Weight(1).shifted_left(bits);
    out.tier = 0;  // 126 and 74 bits
    return out;
}

Approximation approximate(const LatticePoint& p) { return {p.doubles(), 0.0}; }

namespace {

// Errors that are no smaller cover what underflows in filtered_side(), where planes through
// coordinates with fractions have components down to 2^-219 and points coordinates down to 2^-988.
double certain_error(double error) { return error == 0 ? 0 : std::max(error, 0x1p-700); }

}  // namespace

Approximation approximate(const HomogeneousPoint& p) {
    Approximation a;
    a.c = nearest_doubles(p);
    double largest = 0;
    for (double c : a.c) largest = std::max(largest, std::fabs(c));
    // Half a unit in the last place of the largest coordinate.
    a.error = certain_error(largest * detail::unit_roundoff);
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
        if (a.error <= 0x1p-40 * largest) {
            a.error = certain_error(a.error);
            return a;
        }
    }
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "approximating a point of planes that do not meet in one");
    return approximate(*exact);
}

Side side_of(const LatticePoint& point, const Plane& plane) {
    if (const auto s = filtered_side(approximate(point), plane)) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return *s;
    }
    count_exact(plane.tier());
    if (plane.tier() <= 1 && point.is_whole()) {
        WideInt<3> sum(plane.offset());
        for (int i = 0; i < 3; ++i)
            sum += multiply<3>(WideInt<2>(plane.normal(i)), WideInt<1>(point[i].to_integer()));
        return side_from_sign(sum.sign());
    }
    return in_tier(plane.tier(), [&]<class T>(T) {
        const int bits = detail::fraction_bits(point);
        // Coordinates times 2^bits are below 2^(53 + bits).
        return side_from_sign(53 + bits <= bits_of(2)
                                  ? sign_at_fractions<T, 2>(point, bits, plane)
                                  : sign_at_fractions<T, 3>(point, bits, plane));
    });
}

Side side_of(const HomogeneousPoint& point, const Plane& plane) {
    const int tier = std::max(plane.tier(), point.tier);
    count_exact(tier);
    return in_tier(
        tier, [&]<class T>(T) { return side_from_sign(sign_at(tier_point<T>(point), plane)); });
}

namespace {

bool may_be_parallel(const Plane& a, const Plane& b) {
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int l = (i + 2) % 3;
        const double s = a.approx_normal(j) * b.approx_normal(l);
        const double t = a.approx_normal(l) * b.approx_normal(j);
        if (std::fabs(s - t) > detail::minor_rounding * (std::fabs(s) + std::fabs(t))) return false;
    }
    return true;
}

// Of all points of the second plane, to the first one, which is parallel to it. Along the axis of
// its largest component, x = -d/n on the second plane.
template <class T>
int sign_of_parallel(const Plane& plane, const Plane& of) {
    const int axis = of.dominant_axis();
    Columns<T::normal + T::offset - 1> sum;
    add_product(sum, to_digits<T::offset>(plane.offset()), to_digits<T::normal>(of.normal(axis)));
    subtract_product(sum, to_digits<T::offset>(of.offset()),
                     to_digits<T::normal>(plane.normal(axis)));
    return sign_of(sum) * of.normal(axis).sign();
}

// Mostly a point that doubles leave open is in a plane that is one of its own under another name.
template <class T>
std::optional<int> sign_by_parallel(const std::array<const Plane*, 3>& point, const Plane& plane) {
    for (const Plane* const p : point) {
        if (!may_be_parallel(*p, plane)) continue;
        bool is_parallel = true;
        for (int i = 0; i < 3 && is_parallel; ++i)
            is_parallel = sign_of_cross<T>(*p, plane, (i + 1) % 3, (i + 2) % 3) == 0;
        if (is_parallel) return sign_of_parallel<T>(plane, *p);
    }
    return std::nullopt;
}

}  // namespace

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
    const int tier = tier_of(p, q, r, plane);
    count_exact(tier);
    return in_tier(tier, [&]<class T>(T) {
        const auto known = sign_by_parallel<T>({&p, &q, &r}, plane);
        return side_from_sign(known ? *known : sign_at(cramer<T>(p, q, r), plane));
    });
}

namespace {

// Of a number that is not negative.
template <int N>
int used_limbs(const WideInt<N>& v) {
    int n = N;
    while (n > 0 && v.limb(n - 1) == 0) --n;
    return n;
}

// Of a coordinate and a denominator, which is positive. In loops: unrolled, its 272 products are 25
// KB of code. Most numbers have less than half of the digits.
WideInt<33> long_product(const WideInt<17>& a, const WideInt<16>& b) {
    const WideInt<17> size = a.abs();
    const int a_limbs = used_limbs(size);
    const int b_limbs = used_limbs(b);
    WideInt<33> out;
    for (int i = 0; i < a_limbs; ++i) {
        std::uint64_t carry = 0;
        for (int j = 0; j < b_limbs; ++j) {
            const Uint128 t = Uint128{size.limb(i)} * b.limb(j) + out.limb(i + j) + carry;
            out.set_limb(i + j, static_cast<std::uint64_t>(t));
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        out.set_limb(i + b_limbs, carry);
    }
    return a.is_negative() ? -out : out;
}

// In limbs: of xyz and of w.
template <int Xyz, int W>
std::strong_ordering compare_products(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                      std::size_t i) {
    const auto product = [i](const HomogeneousPoint& x, const HomogeneousPoint& y) {
        return multiply<Xyz + W>(WideInt<Xyz>(x.xyz[i]), WideInt<W>(y.w));
    };
    return product(a, b) <=> product(b, a);
}

}  // namespace

std::strong_ordering compare_coordinate(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                        int axis) {
    const auto i = static_cast<std::size_t>(axis);
    // Both denominators are positive. 230 + 174 bits, 398 + 342, or 1070 + 1014.
    if (std::max(a.tier, b.tier) == 0) return compare_products<4, 3>(a, b, i);
    if (a.is_short() && b.is_short()) return compare_products<7, 6>(a, b, i);
    return long_product(a.xyz[i], b.w) <=> long_product(b.xyz[i], a.w);
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
    const int tier = tier_of(a, b);
    count_exact(tier);
    return in_tier(tier, [&]<class T>(T) { return sign_of_cross<T>(a, b, j, l); });
}

int sign_of_dot(const Plane& a, const Plane& b) {
    const int filtered = detail::filter_dot(approx_normal(a), approx_normal(b)).sign();
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (filtered != 0) {
        ++counters.filtered;
        return filtered;
    }
    const int tier = tier_of(a, b);
    count_exact(tier);
    return in_tier(tier, [&]<class T>(T) { return sign_of_dot<T>(a, b); });
}

bool is_same_plane(const Plane& a, const Plane& b) {
    for (int i = 0; i < 3; ++i)
        if (sign_of_cross(a, b, i) != 0) return false;
    // Parallel normals: compare offsets scaled by the other's normal along the dominant axis.
    const int k = a.dominant_axis();
    if (std::max(a.tier(), b.tier()) <= 1) {
        const auto product = [k](const Plane& p, const Plane& q) {
            return multiply<5>(WideInt<3>(p.offset()), WideInt<2>(q.normal(k)));
        };
        return product(a, b) == product(b, a);
    }
    return multiply<12>(a.offset(), b.normal(k)) == multiply<12>(b.offset(), a.normal(k));
}

bool same_orientation(const Plane& a, const Plane& b) { return sign_of_dot(a, b) > 0; }

}  // namespace trisect
