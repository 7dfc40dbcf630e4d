// SPDX-License-Identifier: Apache-2.0
//
// Vectors of GMP's fractions, for the search for certificates.
#pragma once

#include <array>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

using GmpVector = std::array<mpq_class, 3>;

using proof::opposite;

inline bool is_zero(const GmpVector& v) {
    return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0;
}
inline ExactPoint rational(const GmpVector& v) {
    return {from_gmp(v[0]), from_gmp(v[1]), from_gmp(v[2])};
}

}  // namespace trisect::detail
