// SPDX-License-Identifier: Apache-2.0
//
// Where two triangles in space meet, in rationals: every pair of features is tried and points are
// computed.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "vector.h"

namespace reference {

using Triangle3 = std::array<Point3, 3>;

// The part of a triangle that a point is on: corners 0, 1, 2, sides 3, 4, 5 (from corner i to the
// next one), 6 the interior; nothing when it is not in the closed triangle.
std::optional<int> part_at(const Triangle3& triangle, const Point3& point);

// The corners of the intersection, each with the parts of both triangles it is on.
std::map<Point3, std::pair<int, int>> contact(const Triangle3& a, const Triangle3& b);

}  // namespace reference
