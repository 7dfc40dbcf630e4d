// SPDX-License-Identifier: Apache-2.0
//
// Vectors for those who look for certificates: in doubles, to guess, and in fractions. Checkers
// have vectors of their own (certified_points.h).
#pragma once

#include <array>
#include <cmath>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference_certificate.h>

namespace trisect::detail::proof {

using Approximate = std::array<double, 3>;

inline Approximate minus(const Approximate& u, const Approximate& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
inline Approximate cross(const Approximate& u, const Approximate& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline double dot(const Approximate& u, const Approximate& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline double length(const Approximate& v) { return std::sqrt(dot(v, v)); }

inline RationalPoint minus(const RationalPoint& u, const RationalPoint& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
inline RationalPoint cross(const RationalPoint& u, const RationalPoint& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline ExactRational dot(const RationalPoint& u, const RationalPoint& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline RationalPoint opposite(const RationalPoint& v) { return {-v[0], -v[1], -v[2]}; }

inline RationalPoint exact(const Approximate& v) {
    return {ExactRational::from_double(v[0]), ExactRational::from_double(v[1]),
            ExactRational::from_double(v[2])};
}
inline Approximate approximate(const RationalPoint& v) {
    return {v[0].to_double(), v[1].to_double(), v[2].to_double()};
}

}  // namespace trisect::detail::proof
