// SPDX-License-Identifier: Apache-2.0
//
// Integers and fractions of any size behind the measures.
// They come with conversions from the kernel's registers, points in lowest terms and enclosures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

template <int N>
mpz_class to_integer(const WideInt<N>& v) {
    std::array<std::uint64_t, static_cast<std::size_t>(N)> limbs{};
    const WideInt<N> magnitude = v.abs();
    for (int i = 0; i < N; ++i) limbs[static_cast<std::size_t>(i)] = magnitude.limb(i);
    mpz_class z;
    mpz_import(z.get_mpz_t(), limbs.size(), -1, sizeof(std::uint64_t), 0, 0, limbs.data());
    return v.is_negative() ? mpz_class(-z) : z;
}

inline ExactRational to_rational(const mpz_class& numerator, const mpz_class& denominator) {
    return ExactRational::from_limbs(sgn(numerator) < 0, limbs_of(numerator),
                                     limbs_of(denominator));
}

inline mpq_class to_fraction(const ExactRational& v) {
    mpq_class q(v.to_string());
    q.canonicalize();
    return q;
}

// A point in lowest terms.
struct Corner {
    std::array<mpz_class, 3> x;
    mpz_class w;
    std::uint32_t denominator = 0;  // number of w among the different denominators
};

inline Corner corner_at(const Point& point) {
    const HomogeneousPoint h = point.homogeneous();
    Corner c{{to_integer(h.xyz[0]), to_integer(h.xyz[1]), to_integer(h.xyz[2])}, to_integer(h.w)};
    mpz_class common = c.w;
    for (const auto& x : c.x) common = gcd(common, x);
    for (auto& x : c.x) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), common.get_mpz_t());
    mpz_divexact(c.w.get_mpz_t(), c.w.get_mpz_t(), common.get_mpz_t());
    return c;
}

inline mpz_class determinant(const Corner& o, const Corner& p, const Corner& q) {
    return o.x[0] * (p.x[1] * q.x[2] - p.x[2] * q.x[1]) +
           o.x[1] * (p.x[2] * q.x[0] - p.x[0] * q.x[2]) +
           o.x[2] * (p.x[0] * q.x[1] - p.x[1] * q.x[0]);
}

inline mpq_class fraction(const mpz_class& numerator, const mpz_class& denominator) {
    mpq_class q(numerator, denominator);
    q.canonicalize();
    return q;
}

// A number known to lie in [low, low + width] units of 2^-bits.
struct Enclosure {
    mpz_class low;
    mpz_class width;
    unsigned long bits = 0;

    ExactRational lower_end() const { return to_rational(low, mpz_class(1) << bits); }
    ExactRational upper_end() const { return to_rational(low + width, mpz_class(1) << bits); }
};

// Fractional bits of the enclosures to try before the exact sum decides.
inline constexpr std::array<unsigned long, 4> precisions{128, 512, 2048, 8192};

}  // namespace trisect::detail
