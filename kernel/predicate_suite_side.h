// SPDX-License-Identifier: Apache-2.0
//
// Adapter from the library's side_of to predicate_suite.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicate_suite.h>
#include <trisect/kernel/predicates.h>

namespace trisect::predicate_suite {

/// On which side of s the common point of p, q and r is. \pre coefficients are whole numbers
[[nodiscard]] inline int side_by_trisect(const PlaneEquation& p, const PlaneEquation& q,
                                         const PlaneEquation& r, const PlaneEquation& s) {
    const auto plane = [](const PlaneEquation& e) {
        const auto n = [&e](std::size_t i) { return static_cast<std::int64_t>(e[i]); };
        return Plane(n(0), n(1), n(2), Plane::Coefficient(n(3)));
    };
    const Plane a = plane(p);
    const Plane b = plane(q);
    const Plane c = plane(r);
    return sign_of(side_of(approximate(a, b, c), a, b, c, plane(s)));
}

}  // namespace trisect::predicate_suite
