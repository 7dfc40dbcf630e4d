// SPDX-License-Identifier: Apache-2.0
//
// Bounds on the errors of formulas in doubles, with their proofs.
//
// u = 2^-53 is the unit roundoff: fl(a op b) = (a op b)(1 + d) with |d| <= u for sums, products and
// quotients that are 0 or normal, rounded to nearest. No product is contracted with a sum
// (-ffp-contract=off). A product of n factors 1 + d is 1 + t with |t| <= n u / (1 - n u), Higham's
// gamma_n (2002, 3.1). Each constant here is the next power of two above the n that its proof
// needs. The rest pays for terms of second order, and for the roundings of the bound itself, which
// is a few products and sums of doubles, too.
#pragma once

namespace trisect::detail {

inline constexpr double unit_roundoff = 0x1p-53;

/// 1 or -1, or 0 when a value that is within `bound` of v may have either sign.
[[nodiscard]] constexpr int certain_sign(double v, double bound) {
    return (v > bound ? 1 : 0) - (v < -bound ? 1 : 0);
}

/// Times a bound that is itself computed in doubles: pays for its roundings, and for terms of
/// second order that are less than 10^-4 of it.
inline constexpr double bound_slack = 1.0001;

/// Of n · c + d relative to the sum of the magnitudes of its four terms, where n and d carry one
/// rounding each: 8 u. Products carry two, the additions, in any order, three more; one more with
/// the second order makes 6 u.
inline constexpr double plane_value_rounding = 0x1p-50;

/// Times what an error of c, of at most e in each coordinate, moves n · c by: e Σ|n_i|, where n is
/// rounded, and the product is.
inline constexpr double moved_value_slack = 1.0000001;

/// Of det(a, b, c) relative to the sum of the magnitudes of its six products, where components
/// carry one rounding each: 16 u.
///
/// A product of two components carries three roundings, the difference of two of them one more:
/// less than 5 u of the sum of their magnitudes. The product with the third component adds two, the
/// sums two more for each term, and second order what is left to 11 u.
inline constexpr double determinant_rounding = 0x1p-49;

/// Of det(a, b, c) relative to L^2 D, where components are differences of exact doubles, at most
/// L, L and D: 64 u.
///
/// Each carries one rounding. A minor of a and b is within 8 u L^2 of its exact value: two products
/// of at most L^2 that carry three roundings each, and a difference of at most 2 L^2. Three terms
/// of at most 2 L^2 D have 8 u L^2 D from the minor, and as much again from the component of c, the
/// product and the sums: 48 u L^2 D. A point that is off by e in each coordinate moves a component
/// of a difference by e, hence the determinant by at most 6 L^2 e.
inline constexpr double difference_determinant_rounding = 0x1p-47;

}  // namespace trisect::detail
