// SPDX-License-Identifier: Apache-2.0
//
// Pairs of triangles in exact rationals: the oracle of filters and walks. Points of intersection
// are computed, which nothing in the library does, so no formula is shared with it.
#pragma once

#include <array>

#include "reference/rational.h"

namespace brute {

using reference::Point3;
using reference::Rational;
using Triangle3 = std::array<Point3, 3>;

[[nodiscard]] inline Point3 exact(const std::array<double, 3>& p) {
    return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
}

/// m p + t with twelve doubles taken exactly.
[[nodiscard]] Point3 moved(const std::array<std::array<double, 3>, 3>& m,
                           const std::array<double, 3>& t, const Point3& p);

/// Whether two closed triangles, not degenerate, have a common point.
[[nodiscard]] bool meet(const Triangle3& p, const Triangle3& q);
/// Whether a side of one passes through a point of the inside of the other, from one side of its
/// plane to the other.
[[nodiscard]] bool cross(const Triangle3& p, const Triangle3& q);

}  // namespace brute
