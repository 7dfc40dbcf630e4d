// SPDX-License-Identifier: Apache-2.0
//
// Both triangles meet the common line of their planes in an interval. With the corners numbered so
// that the first one is alone on its side of the other plane, and above it, the intervals begin on
// the edges from corner 0 to corner 1 and end on those from 0 to 2, in the same direction; so two
// comparisons decide whether they overlap, and a comparison of two such points along the line is
// the orientation of the four corners.
//
// The filter is filtered_orientation().

#include <trisect/kernel/triangle_pair.h>

#include <cmath>
#include <utility>

#include <trisect/kernel/number/orientation.h>

namespace trisect::detail {

namespace {

// 0 when doubles cannot decide.
int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                const LatticePoint& d) {
    return detail::filtered_orientation(a.doubles(), b.doubles(), c.doubles(), d.doubles());
}

// Numbers the corners so that the first one is alone on its side of the other plane.
std::array<LatticePoint, 3> from_lonely(const SidedTriangle& t, int& side) {
    std::size_t k = 0;
    while (t.sides[k] == t.sides[(k + 1) % 3] || t.sides[k] == t.sides[(k + 2) % 3]) ++k;
    side = t.sides[k];
    return {t.corners[k], t.corners[(k + 1) % 3], t.corners[(k + 2) % 3]};
}

}  // namespace

TrianglePair relate_triangles(const SidedTriangle& a, const SidedTriangle& b) {
    int side_a = 0;
    int side_b = 0;
    auto p = from_lonely(a, side_a);
    auto q = from_lonely(b, side_b);
    // Turning a triangle over puts the other one's first corner above it.
    if (side_a < 0) std::swap(q[1], q[2]);
    if (side_b < 0) std::swap(p[1], p[2]);
    const int first = orientation(p[0], p[1], q[0], q[1]);
    if (first < 0) return TrianglePair::Disjoint;
    const int second = orientation(p[0], p[2], q[2], q[0]);
    if (second < 0) return TrianglePair::Disjoint;
    return first > 0 && second > 0 ? TrianglePair::Crossing : TrianglePair::Unknown;
}

}  // namespace trisect::detail
