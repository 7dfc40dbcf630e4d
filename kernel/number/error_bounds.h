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

/// Of a double that is next to an exact number, or that number: one unit in the last place.
inline constexpr double last_place = 0x1p-52;

/// Times a sum or a product of a few error bounds: at least 1 + 8 u, for the roundings of itself.
inline constexpr double error_slack = 1.0000001;

/// Times a bound that is itself computed in doubles: pays for its roundings, and for terms of
/// second order that are less than 10^-4 of it.
inline constexpr double bound_slack = 1.0001;

/// Times a positive number that some roundings have moved, or its square root: certainly above, or
/// below, the exact one. "Slightly" pays for seven roundings, "surely" for 8000.
inline constexpr double slightly_more = 1 + 0x1p-50;
inline constexpr double slightly_less = 1 - 0x1p-50;
inline constexpr double surely_more = 1 + 0x1p-40;
inline constexpr double surely_less = 1 - 0x1p-40;

/// Of a d - b c relative to |a d| + |b c|, where a, b, c and d carry one rounding each: 8 u.
/// Products carry three, the difference adds one: 4 u.
inline constexpr double minor_rounding = 0x1p-50;

/// Of n · c + d relative to the sum of the magnitudes of its four terms, where n and d carry one
/// rounding each: 8 u. Products carry two, the additions, in any order, three more; one more with
/// the second order makes 6 u. An error of c, of at most e in each coordinate, moves the value by
/// e Σ|n_i|, which error_slack rounds up.
inline constexpr double plane_value_rounding = 0x1p-50;

/// Of det(a, b, c) relative to the sum of the magnitudes of its six products, where components
/// carry one rounding each: 16 u.
///
/// A product of two components carries three roundings, the difference of two of them one more:
/// less than 5 u of the sum of their magnitudes. The product with the third component adds two, the
/// sums two more for each term, and second order what is left to 11 u.
inline constexpr double determinant_rounding = 0x1p-49;

/// Of det(a - d, b - d, c - d) relative to the sum of the magnitudes of its six products, all in
/// doubles, of exact points: 8 u. Shewchuk (1997, 4.4) proves 7 u and terms of second order.
inline constexpr double orientation_rounding = 0x1p-50;

/// Of det(a, b, c) relative to L^2 D, where components are differences of exact doubles, at most
/// L, L and D: 64 u.
///
/// Each carries one rounding. A minor of a and b is within 8 u L^2 of its exact value: two products
/// of at most L^2 that carry three roundings each, and a difference of at most 2 L^2. Three terms
/// of at most 2 L^2 D have 8 u L^2 D from the minor, and as much again from the component of c, the
/// product and the sums: 48 u L^2 D. A point that is off by e in each coordinate moves a component
/// of a difference by e, hence the determinant by at most 6 L^2 e.
inline constexpr double difference_determinant_rounding = 0x1p-47;

/// Of the same for differences of at most g whose exact values are off by at most e.
///
/// With h = e + u g each of the six products is off by at most (g + h)^3 - g^3 < 3.01 g^2 h, and
/// has at most five roundings: 6 · 5.01 u g^3. In all 18.1 g^2 h + 31 u g^3 < 19 g^2 e + 50 u g^3.
[[nodiscard]] constexpr double difference_determinant_bound(double g, double e) {
    return g * g * (20 * e + difference_determinant_rounding * g);
}

/// Of a determinant of two rows of such differences: 4.01 g e + 11 u g^2 in the same way.
[[nodiscard]] constexpr double difference_minor_bound(double g, double e) {
    return g * (5 * e + 0x1p-49 * g);
}

}  // namespace trisect::detail
