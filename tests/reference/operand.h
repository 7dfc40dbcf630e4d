// SPDX-License-Identifier: Apache-2.0
//
// Operands of the naive engine: closed lists of triangles with integer corners.
#pragma once

#include <array>
#include <vector>

#include "canonical_boundary.h"
#include "rational.h"

namespace reference {

// Corners counter-clockwise seen from outside. Triangles without area are admitted and ignored.
using Triangle = std::array<LatticePoint, 3>;
using Operand = std::vector<Triangle>;

// Whether every directed edge occurs as often as its opposite, compared by coordinates: then the
// winding number of every point off the surface is defined.
bool is_balanced(const Operand& operand);

// Sum of the winding number over space: the exact volume of an operand that does not overlap
// itself.
Rational signed_volume(const Operand& operand);

// The triangles of an operand, or of any triangulated result with integer corners, as polygons;
// those without area are left out.
std::vector<Polygon> polygons_of(const Operand& triangles);

}  // namespace reference
