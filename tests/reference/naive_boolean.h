// SPDX-License-Identifier: Apache-2.0
//
// A slow boolean engine in exact rationals, written to be obviously correct: the oracle of the
// differential tests. No tree, no acceleration beyond bounding boxes, no shared code with the
// library.
//
// Operands are closed triangle lists with integer corners; they may intersect and overlap
// themselves, be nested, consist of several shells or be inside out. A point is inside an operand
// by its winding number. The result is the boundary of the regularised set: what separates full
// neighbourhoods inside from full neighbourhoods outside; dangling faces, edges and points vanish.
//
// Cost for n triangles in all: O(n^2) pairs and, per plane, the arrangement of its traces; a ray
// against all triangles per cell. About 3 ms for two operands of 16 triangles each.
#pragma once

#include <vector>

#include "canonical_boundary.h"
#include "expression.h"
#include "operand.h"
#include "plane.h"
#include "rational.h"

namespace reference {

// A convex piece of the result's boundary, corners counter-clockwise seen from outside; collinear
// corners occur. Interiors of cells are disjoint.
struct ConvexCell {
    OrientedPlane plane;  // its normal points out of the result
    std::vector<Point3> vertices;
    std::vector<int> windings_outside;  // of every operand, next to the cell on its positive side
    std::vector<int> windings_inside;   // and on its negative side
};

struct Result {
    std::vector<Operand> operands;
    Indicator indicator;
    std::vector<ConvexCell> cells;
    bool unbounded = false;  // whether points far away are inside
};

// Throws std::invalid_argument if an operand is not balanced.
Result evaluate(const std::vector<Operand>& operands, const Indicator& indicator);
Result evaluate(const std::vector<Operand>& operands, const Expression& expression,
                InsideRule rule = InsideRule::Positive);

enum class Location { Outside, OnBoundary, Inside };

// Membership of a point in the regularised result.
Location locate(const Result& result, const Point3& point);

CanonicalBoundary canonical_boundary(const std::vector<ConvexCell>& cells);

// Whether the boundaries are the same. A set and its complement differ (their planes are opposite),
// but nothing and the whole space have the same empty boundary: compare Result::unbounded, as the
// second form does.
bool same_set(const std::vector<ConvexCell>& a, const std::vector<ConvexCell>& b);
bool same_set(const Result& a, const Result& b);

}  // namespace reference
