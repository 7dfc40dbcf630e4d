// SPDX-License-Identifier: Apache-2.0
//
// Points and planes, for the checkers of certificates.
// No part of the library decides with them. The searches for certificates have their own on
// purpose (proof_vector.h), so that a wrong formula shows; but see certified_clearance.h. Numbers
// are fractions where there are few; signs of all vertices are computed in integers, since
// fractions that are reduced at every step cost ten times as much.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail::certified {

inline ExactPoint minus(const ExactPoint& u, const ExactPoint& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
inline ExactPoint cross(const ExactPoint& u, const ExactPoint& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline ExactRational dot(const ExactPoint& u, const ExactPoint& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline bool is_zero(const ExactPoint& v) {
    return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0;
}
inline ExactRational sum_of_magnitudes(const ExactPoint& v) {
    ExactRational r;
    for (const ExactRational& c : v) r += c.sign() < 0 ? -c : c;
    return r;
}
inline ExactRational value_at(const SeparatingPlane& plane, const ExactPoint& p) {
    return dot(plane.normal, p) + plane.offset;
}

using IntegerVector = std::array<mpz_class, 3>;

/// u·x + v y, which is all that sides of planes are made of.
inline mpz_class form(const IntegerVector& u, const mpz_class& v, const IntegerVector& x,
                      const mpz_class& y) {
    mpz_class r = v * y;
    for (std::size_t i = 0; i < 3; ++i)
        mpz_addmul(r.get_mpz_t(), u[i].get_mpz_t(), x[i].get_mpz_t());
    return r;
}

/// The point x / w, w > 0, without common factors: equal points have equal numbers.
struct IntegerPoint {
    IntegerVector x;
    mpz_class w = 1;

    IntegerPoint() = default;
    IntegerPoint(IntegerVector numerators, mpz_class denominator)
        : x(std::move(numerators)), w(std::move(denominator)) {
        mpz_class common = w;
        for (const mpz_class& c : x) common = gcd(common, c);
        if (sgn(w) < 0) common = -common;
        if (common == 1) return;
        for (mpz_class& c : x) c /= common;
        w /= common;
    }
    explicit IntegerPoint(const ExactPoint& p) {
        const std::array<mpq_class, 3> c{to_gmp(p[0]), to_gmp(p[1]), to_gmp(p[2])};
        const auto n = common_numerators(c, w);
        x = {n[0], n[1], n[2]};
    }
    [[nodiscard]] ExactPoint rational() const {
        ExactPoint r;
        for (std::size_t i = 0; i < 3; ++i) {
            mpq_class q(x[i], w);
            q.canonicalize();
            r[i] = from_gmp(q);
        }
        return r;
    }
    /// Some order.
    friend bool operator<(const IntegerPoint& a, const IntegerPoint& b) {
        for (std::size_t i = 0; i < 3; ++i)
            if (const int c = cmp(a.x[i], b.x[i]); c != 0) return c < 0;
        return a.w < b.w;
    }
    friend bool operator==(const IntegerPoint& a, const IntegerPoint& b) = default;
};

/// A plane times a positive number.
struct IntegerPlane {
    IntegerVector normal;
    mpz_class offset;

    IntegerPlane() = default;
    explicit IntegerPlane(const SeparatingPlane& plane) {
        const std::array<mpq_class, 4> c{to_gmp(plane.normal[0]), to_gmp(plane.normal[1]),
                                         to_gmp(plane.normal[2]), to_gmp(plane.offset)};
        mpz_class denominator;
        const auto n = common_numerators(c, denominator);
        normal = {n[0], n[1], n[2]};
        offset = n[3];
    }
    /// normal·x + offset, times the point's weight.
    [[nodiscard]] mpz_class value_at(const IntegerPoint& p) const {
        return form(normal, offset, p.x, p.w);
    }
    [[nodiscard]] int side_of(const IntegerPoint& p) const { return sgn(value_at(p)); }
};

}  // namespace trisect::detail::certified
