// SPDX-License-Identifier: Apache-2.0
//
// The kernel's values as numbers of GMP, which the tests trust, and the sources of random input
// that the kernel tests share.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/wide_int.h>

namespace oracle {

using trisect::Int128;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::WideInt;

template <int N>
mpz_class integer(const WideInt<N>& v) {
    mpz_class sum = 0;
    for (int i = N - 1; i >= 0; --i) sum = (sum << 64) + mpz_class(v.limb(i));
    if (v.is_negative()) sum -= mpz_class(1) << (64 * N);
    return sum;
}

inline mpz_class integer(Int128 v) { return integer(WideInt<2>(v)); }
inline mpz_class integer(std::int64_t v) { return mpz_class(static_cast<long>(v)); }

/// The register that holds v modulo 2^(64 N).
template <int N>
WideInt<N> register_of(mpz_class v) {
    const mpz_class modulus = mpz_class(1) << (64 * N);
    v %= modulus;
    if (v < 0) v += modulus;
    WideInt<N> out;
    for (int i = 0; i < N; ++i) {
        const mpz_class limb =
            (v >> static_cast<mp_bitcnt_t>(64 * i)) & mpz_class(~std::uint64_t{0});
        out.set_limb(i, limb.get_ui());
    }
    return out;
}

struct PlaneNumbers {
    std::array<mpz_class, 3> n;
    mpz_class d;
};

inline PlaneNumbers numbers(const Plane& p) {
    return {{integer(p.normal(0)), integer(p.normal(1)), integer(p.normal(2))},
            integer(p.offset())};
}

inline mpz_class det3(const std::array<mpz_class, 3>& a, const std::array<mpz_class, 3>& b,
                      const std::array<mpz_class, 3>& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

using RationalPoint = std::array<mpq_class, 3>;

inline RationalPoint rational(const trisect::HomogeneousPoint& p) {
    RationalPoint out;
    for (std::size_t i = 0; i < 3; ++i) {
        out[i] = mpq_class(integer(p.xyz[i]), integer(p.w));
        out[i].canonicalize();
    }
    return out;
}
inline RationalPoint rational(const trisect::Point& p) { return rational(p.homogeneous()); }
inline RationalPoint rational(const LatticePoint& p) {
    return {mpq_class(p.x.to_double()), mpq_class(p.y.to_double()), mpq_class(p.z.to_double())};
}

/// The common point by Cramer's rule. \pre det(n, n, n) != 0.
inline RationalPoint rational(const Plane& p, const Plane& q, const Plane& r) {
    const PlaneNumbers a = numbers(p);
    const PlaneNumbers b = numbers(q);
    const PlaneNumbers c = numbers(r);
    const mpz_class w = det3(a.n, b.n, c.n);
    RationalPoint out;
    for (std::size_t i = 0; i < 3; ++i) {
        PlaneNumbers u = a;
        PlaneNumbers v = b;
        PlaneNumbers t = c;
        u.n[i] = -a.d;
        v.n[i] = -b.d;
        t.n[i] = -c.d;
        out[i] = mpq_class(det3(u.n, v.n, t.n), w);
        out[i].canonicalize();
    }
    return out;
}

inline int side(const RationalPoint& x, const Plane& plane) {
    const PlaneNumbers p = numbers(plane);
    const mpq_class v = p.n[0] * x[0] + p.n[1] * x[1] + p.n[2] * x[2] + p.d;
    return sgn(v);
}

/// The double nearest to q, ties to even. \pre not in the subnormal range, not too large.
inline double nearest(const mpq_class& q) {
    if (q == 0) return 0;
    const mpq_class a = abs(q);
    long e = static_cast<long>(mpz_sizeinbase(a.get_num().get_mpz_t(), 2)) -
             static_cast<long>(mpz_sizeinbase(a.get_den().get_mpz_t(), 2)) - 53;
    for (;; ++e) {  // a / 2^e in [2^52, 2^53) for one of two candidates
        const mpz_class num =
            e < 0 ? mpz_class(a.get_num() << static_cast<mp_bitcnt_t>(-e)) : a.get_num();
        const mpz_class den =
            e > 0 ? mpz_class(a.get_den() << static_cast<mp_bitcnt_t>(e)) : a.get_den();
        mpz_class m = num / den;
        if (mpz_sizeinbase(m.get_mpz_t(), 2) > 53) continue;
        const mpz_class twice_rest = 2 * (num - m * den);
        if (twice_rest > den || (twice_rest == den && mpz_odd_p(m.get_mpz_t()) != 0)) ++m;
        const double r = std::ldexp(m.get_d(), static_cast<int>(e));
        return sgn(q) < 0 ? -r : r;
    }
}

/// Random numbers of a chosen size; the same seed gives the same numbers on every machine.
class Source {
public:
    explicit Source(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t bits() { return engine_(); }
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    bool coin() { return (engine_() & 1U) != 0; }
    /// |value| < 2^bits
    std::int64_t coordinate(int bits) {
        const auto v = static_cast<std::int64_t>(engine_() >> (64 - bits));
        return coin() ? v : -v;
    }
    std::int64_t between(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
    }
    LatticePoint point(int bits) { return {coordinate(bits), coordinate(bits), coordinate(bits)}; }
    /// |value| < 2^bits, with up to `behind` bits behind the point and 53 in all.
    double fraction(int bits, int behind) {
        const int exponent = static_cast<int>(between(-behind, bits - 1));
        const int length = static_cast<int>(between(1, std::min(53, bits - exponent)));
        return std::ldexp(static_cast<double>(coordinate(length)), exponent);
    }
    LatticePoint point(int bits, int behind) {
        const auto c = [&] { return trisect::Coordinate(fraction(bits, behind)); };
        return {c(), c(), c()};
    }
    Plane plane(int bits, int behind = 0) {
        for (;;) {
            const auto corner = [&] { return behind == 0 ? point(bits) : point(bits, behind); };
            const LatticePoint a = corner();
            const LatticePoint b = corner();
            const LatticePoint c = corner();
            if (!are_collinear(a, b, c)) return Plane::through(a, b, c);
        }
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace oracle
