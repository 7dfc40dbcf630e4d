// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/number/flat_corner.h>

#include <trisect/kernel/number/dyadic.h>

namespace trisect::detail {

// In units of 2^-fraction_limit differences have 127 bits.
WideInt<4> turn_of_fractions(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    const auto way = [](Coordinate from, Coordinate to) {
        return WideInt<2>(scaled_integer(to, fraction_limit)) -
               WideInt<2>(scaled_integer(from, fraction_limit));
    };
    return multiply<4>(way(a.u, b.u), way(a.v, c.v)) - multiply<4>(way(a.v, b.v), way(a.u, c.u));
}

int exact_turn_of_fractions(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    return turn_of_fractions(a, b, c).sign();
}

}  // namespace trisect::detail
