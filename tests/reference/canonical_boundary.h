// SPDX-License-Identifier: Apache-2.0
//
// A description of a solid's boundary that depends on nothing but the point set: two engines agree
// if and only if their canonical boundaries are equal (==), however either of them cut its faces,
// subdivided its edges or ordered its output.
//
// Use: hand over the faces of any result (with holes, triangles, convex pieces, any mixture) as
// Polygons with exact vertices, take canonical_boundary() of both engines and compare. Where they
// differ, explain_difference() names the first difference.
//
// What it is: per oriented plane, the faces in it form a region; the boundary of that region is a
// set of directed segments. Edges between neighbouring pieces of the region cancel, collinear
// neighbours join, so what is left is a function of the region alone. A region with overlapping
// faces (a defect of the engine that made it) shows up as a multiplicity other than one.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plane.h"
#include "rational.h"

namespace reference {

// A face: outer loops counter-clockwise seen from the plane's positive side (outside of the solid),
// holes clockwise, in any order, corners without repetition of the first one. Corners on the
// middle of straight lines are welcome, empty loops and slits are harmless.
struct Polygon {
    OrientedPlane plane;
    std::vector<std::vector<Point3>> loops;
};

// The region is on the left of the direction from -> to, seen from the plane's positive side.
struct BoundarySegment {
    Point3 from;
    Point3 to;
    int multiplicity = 1;

    bool operator==(const BoundarySegment&) const = default;
};

// For every oriented plane that holds a face, the maximal directed segments of its region's
// boundary, sorted. Planes whose faces cancel entirely are absent.
struct CanonicalBoundary {
    std::map<OrientedPlane, std::vector<BoundarySegment>> regions;

    bool empty() const { return regions.empty(); }
    bool operator==(const CanonicalBoundary&) const = default;
};

// Throws std::invalid_argument if a corner is not on its polygon's plane.
CanonicalBoundary canonical_boundary(const std::vector<Polygon>& polygons);

// Exact volume enclosed by the boundary; minus the volume of the complement for an unbounded set.
Rational volume(const CanonicalBoundary& boundary);

// Area of the region of every oriented plane, divided by the length of the plane's normal: the
// region's area vector is this rational number times the integer normal.
std::map<OrientedPlane, Rational> area_ratios(const CanonicalBoundary& boundary);

// The sum of all area vectors, zero for every closed boundary.
std::array<Rational, 3> total_area_vector(const CanonicalBoundary& boundary);

// Corners: ends of maximal segments in some plane. Around every other point the boundary is locally
// a plane or a straight crease, or two of those that touch: where a corner touches the middle of a
// face the point is listed (it is a corner of the touching part), where two creases touch crosswise
// it is not.
std::set<Point3> real_vertices(const CanonicalBoundary& boundary);

// An undirected segment, its ends in lexicographic order.
using Edge = std::pair<Point3, Point3>;

// The creases of the boundary: all segments of all regions, cut at every real vertex on them, each
// listed once however many faces meet there.
std::set<Edge> edges(const CanonicalBoundary& boundary);

// Whether the segments of all regions cancel in space, as those of every closed surface do.
bool is_closed(const CanonicalBoundary& boundary);

// Empty if both are equal; else a sentence about the first difference.
std::string explain_difference(const CanonicalBoundary& a, const CanonicalBoundary& b);

}  // namespace reference
