// SPDX-License-Identifier: Apache-2.0
//
// Vectors for the search for certificates.
// Those in doubles guess, those in fractions prove. Checkers share nothing with them on purpose,
// so they have vectors of their own (certified_points.h).
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail::proof {

using Approximate = Vector3;

template <class Number>
[[nodiscard]] VectorOf<Number> opposite(const VectorOf<Number>& v) {
    return {-v[0], -v[1], -v[2]};
}

inline ExactPoint exact(const Approximate& v) {
    return {ExactRational::from_double(v[0]), ExactRational::from_double(v[1]),
            ExactRational::from_double(v[2])};
}
inline Approximate approximate(const ExactPoint& v) {
    return {v[0].to_double(), v[1].to_double(), v[2].to_double()};
}

}  // namespace trisect::detail::proof
