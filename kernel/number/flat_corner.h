// SPDX-License-Identifier: Apache-2.0
//
// FlatCorner: a lattice point in the projection along an axis, and its turns.
#pragma once

#include <cmath>
#include <compare>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

struct FlatCorner {
    Coordinate u;
    Coordinate v;
    friend constexpr bool operator==(const FlatCorner&, const FlatCorner&) = default;
    friend constexpr std::strong_ordering operator<=>(const FlatCorner&,
                                                      const FlatCorner&) = default;
};

/// The coordinates u and v of a point.
[[nodiscard]] constexpr FlatCorner flat_corner(const LatticePoint& p, int u, int v) {
    return {p[u], p[v]};
}

/// Twice the area of a triangle, positive when it runs counter-clockwise. \pre coordinates are
/// whole. Below 2^108: the sides of a box are below 2^54, and no triangle in it has more than half
/// of its area.
[[nodiscard]] inline Int128 turn_of_integers(const FlatCorner& a, const FlatCorner& b,
                                             const FlatCorner& c) {
    return Int128{difference(b.u, a.u)} * difference(c.v, a.v) -
           Int128{difference(b.v, a.v)} * difference(c.u, a.u);
}

/// The same for any coordinates, in units of 2^-(2 fraction_limit). Below 2^254, since sides of a
/// box are below 2^127 then.
[[nodiscard]] WideInt<4> turn_of_fractions(const FlatCorner& a, const FlatCorner& b,
                                           const FlatCorner& c);

/// The same in doubles, in lattice units. An error of 0 is that of a value of 0.
struct RoundedTurn {
    double value = 0;
    double error = 0;
};

/// Differences round once. They are 0, or too large for products to underflow.
[[nodiscard]] inline RoundedTurn rounded_turn(const FlatCorner& a, const FlatCorner& b,
                                              const FlatCorner& c) {
    const double left = (b.u.to_double() - a.u.to_double()) * (c.v.to_double() - a.v.to_double());
    const double right = (b.v.to_double() - a.v.to_double()) * (c.u.to_double() - a.u.to_double());
    return {left - right, minor_rounding * (std::fabs(left) + std::fabs(right))};
}

/// The sign of the turn where some coordinate has bits behind the point.
[[nodiscard]] int exact_turn_of_fractions(const FlatCorner& a, const FlatCorner& b,
                                          const FlatCorner& c);

/// Sign of p.u q.v - p.v q.u for differences p = b - a and q = c - a; exact.
[[nodiscard]] inline int exact_turn(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    const auto is_whole = [](const FlatCorner& p) { return p.u.is_whole() && p.v.is_whole(); };
    if (!(is_whole(a) && is_whole(b) && is_whole(c))) [[unlikely]]
        return exact_turn_of_fractions(a, b, c);
    const Int128 left = Int128{difference(b.u, a.u)} * difference(c.v, a.v);
    const Int128 right = Int128{difference(b.v, a.v)} * difference(c.u, a.u);
    return left > right ? 1 : (left < right ? -1 : 0);
}

/// The sign of a turn that is known in doubles.
[[nodiscard]] inline int sign_of_turn(const RoundedTurn& rounded, const FlatCorner& a,
                                      const FlatCorner& b, const FlatCorner& c) {
    const int sign = certain_sign(rounded.value, rounded.error);
    return sign != 0 || rounded.error == 0 ? sign : exact_turn(a, b, c);
}

/// 1 for a left turn, -1 for a right turn, 0 on a line. Doubles first.
[[nodiscard]] inline int turn(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    return sign_of_turn(rounded_turn(a, b, c), a, b, c);
}

}  // namespace trisect::detail
