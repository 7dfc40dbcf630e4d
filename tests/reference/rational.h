// SPDX-License-Identifier: Apache-2.0
//
// Numbers and points of the reference engine: integers and rationals of any size (GMP), and points
// with rational coordinates. There is no rounding anywhere in this folder; every comparison is
// exact, and std::array supplies equality and the lexicographic order of points.
//
// The reference engine is the oracle of the differential tests, so it includes no header of the
// library under test.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>

namespace reference {

using Integer = mpz_class;
using Rational = mpq_class;

using Point2 = std::array<Rational, 2>;
using Point3 = std::array<Rational, 3>;

// A point with integer coordinates: the corners of the operands.
using LatticePoint = std::array<std::int64_t, 3>;

inline Integer to_integer(std::int64_t value) {
    static_assert(sizeof(long) == sizeof(std::int64_t), "GMP takes long, not int64_t");
    return Integer(static_cast<long>(value));
}

inline Point3 to_point(const LatticePoint& p) {
    return {Rational(to_integer(p[0])), Rational(to_integer(p[1])), Rational(to_integer(p[2]))};
}

// numerator / denominator in lowest terms; the denominator must not be zero.
inline Rational fraction(const Integer& numerator, const Integer& denominator) {
    Rational value(numerator, denominator);
    value.canonicalize();
    return value;
}

// -1, 0 or 1.
inline int sign(const Integer& value) { return sgn(value); }

inline int sign(const Rational& value) { return sgn(value); }

}  // namespace reference
