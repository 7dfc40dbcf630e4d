// SPDX-License-Identifier: Apache-2.0
//
// A triangle of an operand, as the naive engine sees it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "operand.h"
#include "plane.h"
#include "rational.h"

namespace reference {

using IntegerPoint = std::array<Integer, 3>;

// A triangle with area of some operand.
struct Facet {
    std::size_t operand;
    std::array<IntegerPoint, 3> corners;
    OrientedPlane plane;
    IntegerPoint low;  // bounding box
    IntegerPoint high;
    std::size_t group;  // index of its plane, whichever way it is oriented
};

Integer value_at(const OrientedPlane& plane, const IntegerPoint& p);
Point3 to_point(const IntegerPoint& p);

// The triangles with area of all operands; their groups are not known yet.
std::vector<Facet> gather(const std::vector<Operand>& operands);

// One of the two orientations of a plane, the same for both.
OrientedPlane unoriented(const OrientedPlane& plane);

}  // namespace reference
