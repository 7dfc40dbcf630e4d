// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/plane.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/number/power_of_two.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

using detail::difference;
using detail::to_integers;

namespace {

using Coefficient = Plane::Coefficient;

// Bits of a normal and of an offset that the digits of each tier hold (predicates.cpp).
struct TierBits {
    int normal;
    int offset;
};
constexpr std::array<TierBits, 5> tier_bits{TierBits{56, 83}, TierBits{112, 168},
                                            TierBits{174, 230}, TierBits{230, 286},
                                            TierBits{328, 383}};

// The double nearest to an integer: its 64 leading bits, the last of them set where some bit below
// is, round as it does.
double nearest(const Coefficient& v) {
    const Coefficient a = v.abs();
    const int bits = a.bit_length();
    if (bits == 0) return 0;
    const int top = (bits - 1) / 64;
    const int rest = 64 * (top + 1) - bits;
    std::uint64_t leading = a.limb(top) << rest;
    std::uint64_t below = 0;
    if (top > 0) {
        if (rest > 0) leading |= a.limb(top - 1) >> (64 - rest);
        below = a.limb(top - 1) << rest;
    }
    for (int i = 0; i + 1 < top; ++i) below |= a.limb(i);
    if (below != 0) leading |= 1U;
    const double m = static_cast<double>(leading) * detail::power_of_two(bits - 64);
    return v.is_negative() ? -m : m;
}

// Above this the doubles of a normal are scaled.
constexpr int unscaled_bits = 109;

// Whole coordinates: differences have 54 bits and their products 108, so Int128 is wide enough.
std::array<Int128, 3> whole_normal(const LatticePoint& a, const LatticePoint& b,
                                   const LatticePoint& c) {
    const auto u = difference(b, a);
    const auto v = difference(c, a);
    return {Int128{u[1]} * v[2] - Int128{u[2]} * v[1], Int128{u[2]} * v[0] - Int128{u[0]} * v[2],
            Int128{u[0]} * v[1] - Int128{u[1]} * v[0]};
}

WideInt<3> whole_offset(const std::array<Int128, 3>& n, const LatticePoint& a) {
    const auto x = to_integers(a);
    WideInt<3> d;
    for (std::size_t i = 0; i < 3; ++i) d += multiply<3>(WideInt<2>(n[i]), WideInt<1>(x[i]));
    return -d;
}

// Points as integers in units of 2^-bits, below 2^126.
using FineNumbers = std::array<WideInt<2>, 3>;

FineNumbers fine_numbers(const LatticePoint& p, int bits) {
    return {WideInt<2>(detail::scaled_integer(p.x, bits)),
            WideInt<2>(detail::scaled_integer(p.y, bits)),
            WideInt<2>(detail::scaled_integer(p.z, bits))};
}

// In units of 2^-2 bits, below 2^255.
std::array<WideInt<4>, 3> fine_normal(const FineNumbers& a, const FineNumbers& b,
                                      const FineNumbers& c) {
    std::array<WideInt<4>, 3> n;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        n[i] = multiply<4>(b[j] - a[j], c[k] - a[k]) - multiply<4>(b[k] - a[k], c[j] - a[j]);
    }
    return n;
}

Plane plane_through_fractions(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const int bits =
        std::max({detail::fraction_bits(a), detail::fraction_bits(b), detail::fraction_bits(c)});
    const FineNumbers p = fine_numbers(a, bits);
    const auto n = fine_normal(p, fine_numbers(b, bits), fine_numbers(c, bits));
    Coefficient d;
    for (std::size_t i = 0; i < 3; ++i) d -= multiply<6>(n[i], p[i]);
    const auto normal = [&](std::size_t i) { return Coefficient(n[i]).shifted_left(bits); };
    return {normal(0), normal(1), normal(2), d};
}

Uint128 common_divisor(Uint128 a, Uint128 b) {
    while (b != 0) {
        if ((a | b) >> 64 == 0)
            return std::gcd(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b));
        const Uint128 r = a % b;
        a = b;
        b = r;
    }
    return a;
}

Coefficient halved(Coefficient v) {
    constexpr int limbs = 6;
    for (int i = 0; i < limbs; ++i)
        v.set_limb(i, v.limb(i) >> 1 | (i + 1 < limbs ? v.limb(i + 1) << 63 : 0));
    return v;
}
bool is_odd(const Coefficient& v) { return (v.limb(0) & 1U) != 0; }

// Of magnitudes; the power of two of `a` alone is in the outcome.
Coefficient odd_gcd(Coefficient a, Coefficient b) {
    while (!b.is_zero()) {
        while (!is_odd(b)) b = halved(b);
        if (a > b) std::swap(a, b);
        b -= a;
    }
    return a;
}

// Division without a remainder, bit by bit.
Coefficient quotient(const Coefficient& v, const Coefficient& divisor) {
    Coefficient rest = v.abs();
    Coefficient q;
    for (int bit = rest.bit_length() - divisor.bit_length(); bit >= 0; --bit) {
        const Coefficient part = divisor.shifted_left(bit);
        if (part > rest) continue;
        rest -= part;
        q += Coefficient(1).shifted_left(bit);
    }
    return v.is_negative() ? -q : q;
}

std::array<Coefficient, 3> in_lowest_terms(std::array<Coefficient, 3> n) {
    const auto some_odd = [&] { return is_odd(n[0]) || is_odd(n[1]) || is_odd(n[2]); };
    std::array<bool, 3> negative{};
    for (std::size_t i = 0; i < 3; ++i) {
        negative[i] = n[i].is_negative();
        n[i] = n[i].abs();
    }
    while (!some_odd())
        for (Coefficient& v : n) v = halved(v);
    std::size_t odd = 0;
    while (!is_odd(n[odd])) ++odd;
    const Coefficient divisor = odd_gcd(odd_gcd(n[odd], n[(odd + 1) % 3]), n[(odd + 2) % 3]);
    for (std::size_t i = 0; i < 3; ++i) {
        n[i] = quotient(n[i], divisor);
        if (negative[i]) n[i] = -n[i];
    }
    return n;
}

bool are_whole(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return a.is_whole() && b.is_whole() && c.is_whole();
}

// Whether doubles show that a component of (b - a) × (c - a) is not zero.
bool have_plain_normal(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const detail::Vector3 u = detail::minus(b.doubles(), a.doubles());
    const detail::Vector3 v = detail::minus(c.doubles(), a.doubles());
    for (std::size_t i = 0; i < 3; ++i) {
        const double p = u[(i + 1) % 3] * v[(i + 2) % 3];
        const double q = u[(i + 2) % 3] * v[(i + 1) % 3];
        if (std::fabs(p - q) > detail::minor_rounding * (std::fabs(p) + std::fabs(q))) return true;
    }
    return false;
}

bool are_zero(const std::array<WideInt<4>, 3>& n) {
    return n[0].is_zero() && n[1].is_zero() && n[2].is_zero();
}

}  // namespace

Plane::Plane(const std::array<Int128, 3>& n, const WideInt<3>& d) : d_(d), fd_(d.to_double()) {
    Uint128 bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        n_[i] = n[i];
        fn_[i] = static_cast<double>(n[i]);
        bits |= detail::unsigned_magnitude(n[i]);
    }
    const bool narrow = bits >> tier_bits[0].normal == 0 && d.bit_length() <= tier_bits[0].offset;
    tier_ = narrow ? 0 : 1;
}

Plane::Plane(const Coefficient& nx, const Coefficient& ny, const Coefficient& nz,
             const Coefficient& d)
    : n_{nx, ny, nz}, d_(d) {
    const int normal_bits = std::max({nx.bit_length(), ny.bit_length(), nz.bit_length()});
    const int offset_bits = d.bit_length();
    if (normal_bits > tier_bits.back().normal || offset_bits > tier_bits.back().offset)
        throw LimitError("a plane's coefficients exceed their bound");
    while (normal_bits > tier_bits[tier_].normal || offset_bits > tier_bits[tier_].offset) ++tier_;
    shift_ = static_cast<std::int16_t>(std::max(normal_bits - unscaled_bits, 0));
    const double unit = detail::power_of_two(-shift_);
    for (std::size_t i = 0; i < 3; ++i) fn_[i] = nearest(n_[i]) * unit;
    fd_ = nearest(d_) * unit;
}

Plane Plane::through(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    if (!are_whole(a, b, c)) [[unlikely]] {
        const Plane p = plane_through_fractions(a, b, c);
        TRISECT_EXPECTS(p.is_valid(), "plane through collinear points");
        return p;
    }
    const auto n = whole_normal(a, b, c);
    TRISECT_EXPECTS(n[0] != 0 || n[1] != 0 || n[2] != 0, "plane through collinear points");
    return {n, whole_offset(n, a)};
}

// (b - a) × e_axis has two components of 54 bits, so that the offset fits into 128 bits.
Plane Plane::along_axis(const LatticePoint& a, const LatticePoint& b, int axis) {
    const int j = (axis + 1) % 3;
    const int l = (axis + 2) % 3;
    TRISECT_EXPECTS(a[j] != b[j] || a[l] != b[l], "edge parallel to the axis of its plane");
    Plane p;
    if (!(a[j].is_whole() && a[l].is_whole() && b[j].is_whole() && b[l].is_whole())) [[unlikely]] {
        const int bits = std::max({detail::fraction_bits(a[j]), detail::fraction_bits(a[l]),
                                   detail::fraction_bits(b[j]), detail::fraction_bits(b[l])});
        const auto fine = [bits](Coordinate c) {
            return WideInt<3>(detail::scaled_integer(c, bits));
        };
        const WideInt<3> nj = fine(b[l]) - fine(a[l]);
        const WideInt<3> nl = fine(a[j]) - fine(b[j]);
        std::array<Coefficient, 3> n{};
        n[static_cast<std::size_t>(j)] = Coefficient(nj).shifted_left(bits);
        n[static_cast<std::size_t>(l)] = Coefficient(nl).shifted_left(bits);
        return {n[0], n[1], n[2], -(multiply<6>(nj, fine(a[j])) + multiply<6>(nl, fine(a[l])))};
    }
    const std::int64_t nj = difference(b[l], a[l]);
    const std::int64_t nl = difference(a[j], b[j]);
    const auto set = [&](int i, std::int64_t v) {
        p.n_[static_cast<std::size_t>(i)] = v;
        p.fn_[static_cast<std::size_t>(i)] = static_cast<double>(v);
    };
    set(j, nj);
    set(l, nl);
    const Int128 d = -(Int128{nj} * a[j].to_integer() + Int128{nl} * a[l].to_integer());
    p.d_ = d;
    p.fd_ = WideInt<2>(d).to_double();
    p.tier_ = detail::unsigned_magnitude(d) >> tier_bits[0].offset != 0 ? 1 : 0;
    return p;
}

Plane Plane::axis_aligned(int axis, std::int64_t scale, std::int64_t position) {
    std::array<Int128, 3> n{};
    n[static_cast<std::size_t>(axis)] = scale;
    return {n, -WideInt<3>(position)};
}

Plane Plane::flipped() const {
    Plane p = *this;
    for (std::size_t i = 0; i < 3; ++i) {
        p.n_[i] = -n_[i];
        p.fn_[i] = -fn_[i];
    }
    p.d_ = -d_;
    p.fd_ = -fd_;
    return p;
}

int Plane::largest_normal(int i, int j, int k) const {
    const auto largest = [&](const auto& size) {
        int best = i;
        if (size(j) > size(best)) best = j;
        if (size(k) > size(best)) best = k;
        return best;
    };
    if (tier_ <= 1)
        return largest([this](int axis) {
            return detail::unsigned_magnitude(detail::to_int128(normal(axis)));
        });
    return largest([this](int axis) { return normal(axis).abs(); });
}

int Plane::dominant_axis() const { return largest_normal(0, 1, 2); }

std::array<Plane::Coefficient, 3> Plane::direction() const {
    if (tier_ > 1) return in_lowest_terms(n_);
    std::array<Coefficient, 3> out;
    Uint128 divisor = 0;
    for (const Coefficient& v : n_)
        divisor = common_divisor(detail::unsigned_magnitude(detail::to_int128(v)), divisor);
    for (std::size_t i = 0; i < 3; ++i) {
        const Int128 v = detail::to_int128(n_[i]);
        const auto q = static_cast<Int128>(detail::unsigned_magnitude(v) / divisor);
        out[i] = v < 0 ? -q : q;
    }
    return out;
}

bool are_collinear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    if (have_plain_normal(a, b, c)) return false;
    if (!are_whole(a, b, c)) [[unlikely]] {
        const int bits = std::max(
            {detail::fraction_bits(a), detail::fraction_bits(b), detail::fraction_bits(c)});
        return are_zero(
            fine_normal(fine_numbers(a, bits), fine_numbers(b, bits), fine_numbers(c, bits)));
    }
    const auto n = whole_normal(a, b, c);
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

}  // namespace trisect
