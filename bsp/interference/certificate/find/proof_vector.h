// SPDX-License-Identifier: Apache-2.0
//
// Vectors for the search for certificates.
// Those in doubles guess, those in fractions prove. Checkers share nothing with them on purpose,
// so they have vectors of their own (certified_points.h).
#pragma once

#include <array>
#include <cmath>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::proof {

using Approximate = std::array<double, 3>;

template <class Number>
[[nodiscard]] std::array<Number, 3> minus(const std::array<Number, 3>& u,
                                          const std::array<Number, 3>& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
template <class Number>
[[nodiscard]] std::array<Number, 3> cross(const std::array<Number, 3>& u,
                                          const std::array<Number, 3>& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
template <class Number>
[[nodiscard]] Number dot(const std::array<Number, 3>& u, const std::array<Number, 3>& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
template <class Number>
[[nodiscard]] std::array<Number, 3> opposite(const std::array<Number, 3>& v) {
    return {-v[0], -v[1], -v[2]};
}

inline double length(const Approximate& v) { return std::sqrt(dot(v, v)); }

inline RationalPoint exact(const Approximate& v) {
    return {ExactRational::from_double(v[0]), ExactRational::from_double(v[1]),
            ExactRational::from_double(v[2])};
}
inline Approximate approximate(const RationalPoint& v) {
    return {v[0].to_double(), v[1].to_double(), v[2].to_double()};
}

}  // namespace trisect::detail::proof
