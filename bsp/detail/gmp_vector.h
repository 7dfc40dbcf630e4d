// SPDX-License-Identifier: Apache-2.0
//
// Vectors of GMP's fractions, for those who look for certificates.
#pragma once

#include <gmpxx.h>

#include <array>

#include <trisect/brep/detail/gmp_conversion.h>
#include <trisect/bsp/interference_certificate.h>

namespace trisect::detail {

using GmpVector = std::array<mpq_class, 3>;

inline GmpVector minus(const GmpVector& u, const GmpVector& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
inline GmpVector cross(const GmpVector& u, const GmpVector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline mpq_class dot(const GmpVector& u, const GmpVector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline GmpVector opposite(const GmpVector& v) { return {-v[0], -v[1], -v[2]}; }
inline bool is_zero(const GmpVector& v) {
    return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0;
}
inline RationalPoint rational(const GmpVector& v) {
    return {from_gmp(v[0]), from_gmp(v[1]), from_gmp(v[2])};
}

}  // namespace trisect::detail
