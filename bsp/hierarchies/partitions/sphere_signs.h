// SPDX-License-Identifier: Apache-2.0
//
// Exact orientation and in-sphere signs for a Delaunay mesh.
// They are exact for integer points below 2^55.
#pragma once

#include <array>
#include <cstdint>

namespace trisect::hierarchies {

using IntegerPoint = std::array<std::int64_t, 3>;

/// Sign of det(b - a, c - a, d - a): 1 when d sees a, b, c clockwise, that is when the tetrahedron
/// is positive.
[[nodiscard]] int orientation(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c,
                              const IntegerPoint& d);

/// 1 when p is strictly inside of the sphere through the corners of a positive tetrahedron, 0 on
/// it.
[[nodiscard]] int side_of_sphere(const std::array<IntegerPoint, 4>& t, const IntegerPoint& p);

}  // namespace trisect::hierarchies
