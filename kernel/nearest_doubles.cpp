// SPDX-License-Identifier: Apache-2.0
//
// Rounding points of planes correctly: a function of the exact point alone. A mesh that is written
// rounds every vertex that a cut has made, so nearly all go without wide integers.
//
// One step of iterative refinement: the residuals of the approximate point are exact, so what is
// missing, a tiny vector, is known to many digits, and the sum to more digits than a double has. If
// both ends of the enclosure round to the same double, that is it.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <type_traits>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/power_of_two.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/refined_point.h>

namespace trisect {

using detail::cross;
using detail::determinant_rounding;
using detail::DoublePair;
using detail::largest_component;
using detail::power_of_two;
using detail::Vector3;

namespace {

// 0 <= v < 2^126, within two roundings.
double to_double(Uint128 v) {
    constexpr std::uint64_t low = (std::uint64_t{1} << 63) - 1;
    return static_cast<double>(static_cast<std::int64_t>(v >> 63)) * 0x1p63 +
           static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(v) & low));
}

Vector3 normal_of(const Plane& p) {
    return {p.approx_normal(0), p.approx_normal(1), p.approx_normal(2)};
}

double sum_of_magnitudes(const Vector3& v) {
    return std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]);
}

// n·c + d 2^k at integers c below 2^61, 0 <= k <= 100, that are within `reach` of a point of the
// plane: exact, then rounded at most twice. It is at most reach Σ|n_i|, so it mostly has fewer than
// 127 bits, and then its terms need no more either: all is modulo 2^128. Else |d| 2^k is at most
// about 3 max|n| 2^61, so 177 bits hold all terms on whole coordinates. The result is scaled as the
// plane's doubles are.
double residual(const Plane& plane, const std::array<std::int64_t, 3>& c, int k, double reach) {
    const double unit = power_of_two(-plane.approx_shift());
    if (sum_of_magnitudes(normal_of(plane)) * reach < 0x1p125 * unit) [[likely]] {
        const Plane::Coefficient& d = plane.offset();
        Uint128 sum = (Uint128{d.limb(1)} << 64 | d.limb(0)) << k;
        for (int i = 0; i < 3; ++i)
            sum += (Uint128{plane.normal(i).limb(1)} << 64 | plane.normal(i).limb(0)) *
                   static_cast<Uint128>(Int128{c[static_cast<std::size_t>(i)]});
        const bool negative = (sum >> 127) != 0;
        const double size = to_double(negative ? -sum : sum);
        return (negative ? -size : size) * unit;
    }
    const auto wide = [&]<int N>(std::integral_constant<int, N>) {
        auto sum = WideInt<N>(plane.offset()).shifted_left(k);
        for (int i = 0; i < 3; ++i)
            sum += multiply<N>(plane.normal(i), WideInt<1>(c[static_cast<std::size_t>(i)]));
        return sum.to_double() * unit;
    };
    // 484 bits above the first two tiers.
    return plane.tier() <= 1 ? wide(std::integral_constant<int, 3>())
                             : wide(std::integral_constant<int, 8>());
}

// Three planes n·x + d = 0, in doubles. `size` is |d|, and where d may be off by more than its
// roundings 1 / determinant_rounding times that: so bounds that are proportional to it have both.
struct System {
    std::array<Vector3, 3> n{};
    Vector3 d{};
    Vector3 size{};
    void set_offset(std::size_t row, double offset, double error = 0) {
        d[row] = offset;
        size[row] = std::fabs(offset) + error * (1 / determinant_rounding);
    }
};

// How far the determinants of Cramer's rule may be off. Coefficients carry one rounding each,
// offsets two: 12 u of determinant_rounding's 16.
struct Bounds {
    double w = 0;
    Vector3 x{};
};

// The products are some of those that the product of the normals' sums of magnitudes has.
Bounds rough_bounds(const System& s) {
    const double p = sum_of_magnitudes(s.n[0]);
    const double q = sum_of_magnitudes(s.n[1]);
    const double r = sum_of_magnitudes(s.n[2]);
    const double x =
        determinant_rounding * (s.size[0] * (q * r) + s.size[1] * (r * p) + s.size[2] * (p * q));
    return {determinant_rounding * (p * q * r), {x, x, x}};
}

// Product by product. On axis-perpendicular planes most are 0, and a coordinate that is 0 must be
// known exactly to be rounded.
Bounds sharp_bounds(const System& s) {
    Bounds out;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3& a = s.n[(k + 1) % 3];
        const Vector3& b = s.n[(k + 2) % 3];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t l = (i + 2) % 3;
            const double minor =
                determinant_rounding * (std::fabs(a[j] * b[l]) + std::fabs(a[l] * b[j]));
            out.x[i] += s.size[k] * minor;
            if (k == 0) out.w += std::fabs(s.n[0][i]) * minor;
        }
    }
    return out;
}

// A vector with a bound of the error of each component.
struct Enclosed {
    Vector3 c{};
    Vector3 error{};
};

std::optional<Enclosed> solve(const System& s, const Bounds& bounds) {
    const Vector3 qr = cross(s.n[1], s.n[2]);
    const Vector3 rp = cross(s.n[2], s.n[0]);
    const Vector3 pq = cross(s.n[0], s.n[1]);
    const double w = s.n[0][0] * qr[0] + s.n[0][1] * qr[1] + s.n[0][2] * qr[2];
    // Then |w| - δw is at least 3/4 |w|; beyond, the quotient's error is not linear any more.
    if (!(bounds.w < 0.25 * std::fabs(w))) return std::nullopt;
    const double inverse = -1 / w;
    const double scale = 1.3334 * std::fabs(inverse);
    Enclosed out;
    for (std::size_t i = 0; i < 3; ++i) {
        out.c[i] = (s.d[0] * qr[i] + s.d[1] * rp[i] + s.d[2] * pq[i]) * inverse;
        // |X/W - x/w| <= (δx + |x/w| δw) / (|w| - δw), plus two roundings.
        const double c = std::fabs(out.c[i]);
        out.error[i] = (bounds.x[i] + c * bounds.w) * scale + c * 0x1p-51;
    }
    return out;
}

// The double that both ends of an enclosure about an integer round to.
std::optional<Vector3> rounded(const std::array<std::int64_t, 3>& c, const Enclosed& step) {
    Vector3 out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto at = static_cast<double>(c[i]);
        // The last term pays for the rounding of step - error and step + error.
        const double error = detail::bound_slack * step.error[i] + 0x1p-51 * std::fabs(step.c[i]);
        out[i] = at + (step.c[i] - error);
        if (out[i] != at + (step.c[i] + error)) return std::nullopt;
    }
    return out;
}

// An approximate point as integers times 2^-k.
struct NearPoint {
    std::array<std::int64_t, 3> c{};
    int k = 0;
    double reach = 0;  // from the exact one
};

std::optional<NearPoint> near_point(const Approximation& a) {
    const double largest = std::max(largest_component(a.c), 0x1p-40);
    // In units of 2^-k the largest coordinate has 61 bits. A double has 53, so it is exact; what
    // others have below that is cut off.
    NearPoint out;
    out.k = 60 - (static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - 1023);
    if (out.k < 0) return std::nullopt;
    const double scale = power_of_two(out.k);
    for (std::size_t i = 0; i < 3; ++i) out.c[i] = static_cast<std::int64_t>(a.c[i] * scale);
    out.reach = a.error * scale + 1;
    return out;
}

std::optional<Vector3> nearest_by(const System& system, const NearPoint& near) {
    const auto rounded_with = [&](const Bounds& bounds) -> std::optional<Vector3> {
        const auto step = solve(system, bounds);
        return step ? rounded(near.c, *step) : std::nullopt;
    };
    auto nearest = rounded_with(rough_bounds(system));
    if (!nearest) nearest = rounded_with(sharp_bounds(system));
    if (!nearest) return std::nullopt;
    const double unit = power_of_two(-near.k);
    for (double& v : *nearest) v *= unit;
    return nearest;
}

void add_made_plane(const Plane& plane, const NearPoint& near, std::size_t row, System& system) {
    system.n[row] = normal_of(plane);
    system.set_offset(row, residual(plane, near.c, near.k, near.reach));
}

System made_planes(const Plane& p, const Plane& q, const Plane& r, const NearPoint& near) {
    System system;
    add_made_plane(p, near, 0, system);
    add_made_plane(q, near, 1, system);
    add_made_plane(r, near, 2, system);
    return system;
}

std::optional<Vector3> filtered_nearest(const Approximation& a, const Plane& p, const Plane& q,
                                        const Plane& r) {
    const auto near = near_point(a);
    if (!near) return std::nullopt;
    return nearest_by(made_planes(p, q, r, *near), *near);
}

// Of at most 126 bits, within two roundings.
double signed_to_double(Uint128 v) { return (v >> 127) != 0 ? -to_double(-v) : to_double(v); }

// The normal, of at most 109 bits, and the residual as above, of which the way from a corner does
// not change anything. Normals carry two roundings, too: with that determinants are within 14 u.
// False where the residual may have more than 126 bits.
bool add_whole_plane(const CornerPlane& plane, const NearPoint& near, std::size_t row,
                     System& system) {
    const LatticePoint& a = *plane.corners[0];
    const auto way = [&](std::size_t corner, std::size_t k) {
        const auto axis = static_cast<int>(k);
        return (*plane.corners[corner])[axis].to_integer() - a[axis].to_integer();
    };
    std::array<Int128, 3> n{};
    if (plane.axis < 0) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t l = (i + 2) % 3;
            n[i] = Int128{way(1, j)} * way(2, l) - Int128{way(1, l)} * way(2, j);
        }
    } else {
        const auto k = static_cast<std::size_t>(plane.axis);
        n[(k + 1) % 3] = way(1, (k + 2) % 3);
        n[(k + 2) % 3] = -way(1, (k + 1) % 3);
    }
    Uint128 sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Int128 at = a[static_cast<int>(i)].to_integer();
        const Uint128 from =
            static_cast<Uint128>(Int128{near.c[i]}) - (static_cast<Uint128>(at) << near.k);
        sum += static_cast<Uint128>(n[i]) * from;
        system.n[row][i] = signed_to_double(static_cast<Uint128>(n[i]));
    }
    system.set_offset(row, signed_to_double(sum));
    return sum_of_magnitudes(system.n[row]) * near.reach < 0x1p125;
}

using PairVector = std::array<DoublePair, 3>;

// to - from in pairs: exact.
PairVector way_in_pairs(const Vector3& from, const Vector3& to) {
    PairVector out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = detail::two_sum(to[i], -from[i]);
    return out;
}

// A normal in pairs, and for each component the sum of the magnitudes of its two products, of which
// it is off by less than 2^-101.
struct PairNormal {
    PairVector n{};
    Vector3 size{};
};

// A product is off by 2^-102 of itself, their difference by 2^-103 of both. Where equal products
// are subtracted, 0 is exact. False where too little is left of a component: less than 2^-47 of
// its size, by which an error of 2^-101 is one of half a rounding.
bool normal_in_pairs(const PairVector& u, const PairVector& v, PairNormal& out) {
    const auto are_same = [](const DoublePair& a, const DoublePair& b) {
        return a.high == b.high && a.low == b.low;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        out.size[k] = std::fabs(u[i].high * v[j].high) + std::fabs(u[j].high * v[i].high);
        if (are_same(u[i], v[i]) && are_same(u[j], v[j])) continue;
        out.n[k] = detail::subtract(detail::multiply(u[i], v[j]), detail::multiply(u[j], v[i]));
        if (std::fabs(out.n[k].high) < 0x1p-47 * out.size[k]) return false;
    }
    return true;
}

// The same of corners with bits behind the point. The way from a corner, in units of 2^-k, is
// exact. Its product with the normal is off by 2^-101 of the sum of the magnitudes of all products
// for the normal, by 2^-102 of it for the multiplications and for the two additions: in all by less
// than 2^-100, and 2^-99 pays for the roundings of that sum.
bool add_fine_plane(const CornerPlane& plane, const NearPoint& near, std::size_t row,
                    System& system) {
    const Vector3 a = plane.corners[0]->doubles();
    const PairVector u = way_in_pairs(a, plane.corners[1]->doubles());
    PairNormal normal;
    if (plane.axis < 0) {
        if (!normal_in_pairs(u, way_in_pairs(a, plane.corners[2]->doubles()), normal)) return false;
    } else {
        const std::size_t i = (static_cast<std::size_t>(plane.axis) + 1) % 3;
        const std::size_t j = (i + 1) % 3;
        normal.n[i] = u[j];
        normal.n[j] = detail::negated(u[i]);
        normal.size[i] = std::fabs(u[j].high);
        normal.size[j] = std::fabs(u[i].high);
    }
    const double scale = power_of_two(near.k);
    DoublePair sum;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const DoublePair way = detail::two_sum(static_cast<double>(near.c[i]), -(a[i] * scale));
        sum = detail::add(sum, detail::multiply(normal.n[i], way));
        size += normal.size[i] * std::fabs(way.high);
        system.n[row][i] = normal.n[i].high;
    }
    system.set_offset(row, sum.high, 0x1p-99 * size);
    return true;
}

bool add_plane(const CornerPlane& plane, const NearPoint& near, std::size_t row, System& system) {
    if (plane.made != nullptr) {
        add_made_plane(*plane.made, near, row, system);
        return true;
    }
    return plane.is_whole ? add_whole_plane(plane, near, row, system)
                          : add_fine_plane(plane, near, row, system);
}

std::optional<System> corner_planes(const std::array<CornerPlane, 3>& planes,
                                    const NearPoint& near) {
    System system;
    for (std::size_t i = 0; i < 3; ++i)
        if (!add_plane(planes[i], near, i, system)) return std::nullopt;
    return system;
}

// The integers and the step, which are exact as doubles.
std::optional<RefinedPoint> refined_by(const System& system, const NearPoint& near) {
    const auto step = solve(system, rough_bounds(system));
    if (!step) return std::nullopt;
    const double unit = power_of_two(-near.k);
    RefinedPoint out;
    for (std::size_t i = 0; i < 3; ++i) {
        const DoublePair sum =
            detail::two_sum(static_cast<double>(near.c[i]) * unit, step->c[i] * unit);
        out.high[i] = sum.high;
        out.low[i] = sum.low;
        out.error = std::max(out.error, detail::bound_slack * step->error[i] * unit);
    }
    return out;
}

}  // namespace

namespace {

// Within a few roundings.
template <int N>
double rough_quotient(const WideInt<N>& n, const WideInt<N>& d) {
    if constexpr (64 * N < 1000) return n.to_double() / d.to_double();
    const auto a = detail::BoundedInt(n).scaled();
    const auto b = detail::BoundedInt(d).scaled();
    return std::ldexp(a.mantissa / b.mantissa, a.exponent - b.exponent);
}

// N limbs hold the numbers, and the smaller one with as many bits as the other one has, and 56.
template <int N>
double nearest_quotient(const WideInt<N>& numerator, const WideInt<N>& denominator) {
    if (numerator.is_zero()) return 0;
    // Scale so that the integer quotient q has 55 or 56 bits: n = |numerator| 2^k, or the divisor
    // takes 2^-k.
    WideInt<N> n = numerator.abs();
    WideInt<N> d(denominator);
    const int k = 55 - (n.bit_length() - d.bit_length());
    (k >= 0 ? n : d) = (k >= 0 ? n : d).shifted_left(std::abs(k));
    // Two quotients of doubles leave an error of a few units; the exact remainder corrects it and
    // proves q: 0 <= rest < d.
    std::int64_t q = 0;
    WideInt<N> rest = n;
    for (int step = 0; step < 2; ++step) {
        const auto t = static_cast<std::int64_t>(rough_quotient(rest, d));
        q += t;
        rest -= multiply<N>(d, WideInt<1>(t));
    }
    for (; rest.is_negative(); rest += d) --q;
    for (; rest >= d; rest -= d) ++q;
    // Round to 53 bits, to nearest, ties to even.
    const int dropped = 11 - std::countl_zero(static_cast<std::uint64_t>(q));
    const std::int64_t half = std::int64_t{1} << (dropped - 1);
    const std::int64_t low = q & (2 * half - 1);
    std::int64_t m = q >> dropped;
    if (low > half || (low == half && (!rest.is_zero() || (m & 1) != 0))) ++m;
    const double r = std::ldexp(static_cast<double>(m), dropped - k);
    return numerator.is_negative() ? -r : r;
}

// Of the first two tiers: 398 and 342 bits.
double short_quotient(const HomogeneousPoint& p, std::size_t k) {
    return nearest_quotient(WideInt<7>(p.xyz[k]), WideInt<7>(p.w));
}

}  // namespace

double nearest_double(const HomogeneousPoint::Coordinate& numerator,
                      const HomogeneousPoint::Weight& denominator) {
    return nearest_quotient(WideInt<18>(numerator), WideInt<18>(denominator));
}

std::array<double, 3> nearest_doubles(const HomogeneousPoint& p) {
    if (p.is_short()) return {short_quotient(p, 0), short_quotient(p, 1), short_quotient(p, 2)};
    return {nearest_double(p.xyz[0], p.w), nearest_double(p.xyz[1], p.w),
            nearest_double(p.xyz[2], p.w)};
}

std::optional<std::array<double, 3>> nearest_doubles(const Approximation& approximation,
                                                     const std::array<CornerPlane, 3>& planes) {
    const auto near = near_point(approximation);
    if (!near) return std::nullopt;
    const auto system = corner_planes(planes, *near);
    if (!system) return std::nullopt;
    const auto nearest = nearest_by(*system, *near);
    if (nearest) ++detail::counters_of_thread<PredicateCounters>.filtered;
    return nearest;
}

std::optional<RefinedPoint> refined_point(const Approximation& approximation, const Plane& p,
                                          const Plane& q, const Plane& r) {
    const auto near = near_point(approximation);
    if (!near) return std::nullopt;
    return refined_by(made_planes(p, q, r, *near), *near);
}

std::optional<RefinedPoint> refined_point(const Approximation& approximation,
                                          const std::array<CornerPlane, 3>& planes) {
    const auto near = near_point(approximation);
    if (!near) return std::nullopt;
    const auto system = corner_planes(planes, *near);
    return system ? refined_by(*system, *near) : std::nullopt;
}

std::array<double, 3> nearest_doubles(const Approximation& approximation, const Plane& p,
                                      const Plane& q, const Plane& r) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (const auto nearest = filtered_nearest(approximation, p, q, r)) {
        ++counters.filtered;
        return *nearest;
    }
    if (p.is_narrow() && q.is_narrow() && r.is_narrow()) {
        ++counters.exact_narrow;
    } else {
        ++counters.exact_wide;
    }
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "rounding a point of planes that do not meet in one");
    return nearest_doubles(*exact);
}

}  // namespace trisect
