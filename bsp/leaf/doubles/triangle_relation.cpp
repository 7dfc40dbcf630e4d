// SPDX-License-Identifier: Apache-2.0
//
// Two triangles in general position meet in a segment or not at all. Both meet the common line of
// their planes in an interval, if their corners are on both sides of the other one's plane. With
// the corners numbered so that the first one is alone on its side, every end of an interval is
// where an edge from that corner pierces the other plane, and the order of two such points, one of
// either triangle, is the orientation of the four corners (Guigue and Devillers, "Fast and robust
// triangle-triangle overlap test using orientation predicates", 2003). Four orientations decide
// whether the intervals overlap and which points are the ends of what they share. No plane in
// integers is made for that.

#include <trisect/bsp/leaf/doubles/triangle_relation.h>

#include <utility>

#include <trisect/kernel/number/orientation.h>

namespace trisect::detail {

namespace {

// Corners of one triangle with respect to the plane of another one.
struct CornerSides {
    std::array<double, 3> value{};
    int above = 0;
    int below = 0;

    CornerSides(const FilteredPlane& plane, const std::array<Vector3, 3>& corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            value[i] = plane.value(corners[i]);
            above += value[i] > plane.bound ? 1 : 0;
            below += value[i] < -plane.bound ? 1 : 0;
        }
    }
    [[nodiscard]] bool is_off() const { return above == 3 || below == 3; }
    [[nodiscard]] bool is_sure() const { return above + below == 3; }
    /// The corner that is alone on its side. \pre is_sure() and not is_off()
    [[nodiscard]] std::size_t lonely() const {
        const bool up = above == 1;
        return (value[0] > 0) == up ? 0 : ((value[1] > 0) == up ? 1 : 2);
    }
    [[nodiscard]] unsigned bits() const {
        return (value[0] > 0 ? 1U : 0U) | (value[1] > 0 ? 2U : 0U) | (value[2] > 0 ? 4U : 0U);
    }
};

// A triangle's corners, the lonely one first, and turned over if need be so that the other one's
// lonely corner is above it.
struct Numbered {
    std::array<std::size_t, 3> corner;
    const std::array<Vector3, 3>& points;

    Numbered(const std::array<Vector3, 3>& all, std::size_t lonely, bool turned) : points(all) {
        corner = {lonely, (lonely + 1) % 3, (lonely + 2) % 3};
        if (turned) std::swap(corner[1], corner[2]);
    }
    [[nodiscard]] const Vector3& operator[](std::size_t i) const { return points[corner[i]]; }
};

}  // namespace

TriangleRelation relate_triangles(const TriangleAndPlane& first, const TriangleAndPlane& second) {
    TriangleRelation out;
    const CornerSides of_b(first.plane, second.corners);
    if (of_b.is_off()) return out;
    const CornerSides of_a(second.plane, first.corners);
    if (of_a.is_off()) return out;
    out.kind = TriangleRelation::Kind::NearPlane;
    if (!of_a.is_sure() || !of_b.is_sure()) return out;
    const std::size_t lonely_a = of_a.lonely();
    const std::size_t lonely_b = of_b.lonely();
    const bool turned_a = of_b.value[lonely_b] < 0;
    const bool turned_b = of_a.value[lonely_a] < 0;
    const Numbered p(first.corners, lonely_a, turned_a);
    const Numbered q(second.corners, lonely_b, turned_b);
    // In the direction of the normals' product, as both are turned now, the interval of a runs from
    // its edge to corner 2 to that to corner 1, the one of b from 1 to 2. order(i, j) > 0: b's edge
    // to corner j comes before a's to corner i.
    const auto order = [&](std::size_t i, std::size_t j) {
        return filtered_orientation(p[0], p[i], q[0], q[j]);
    };
    out.kind = TriangleRelation::Kind::Apart;
    const int start_of_b = order(1, 1);
    if (start_of_b < 0) return out;
    const int start_of_a = order(2, 2);
    if (start_of_a > 0) return out;
    const int starts = order(2, 1);
    const int ends = order(1, 2);
    out.kind = TriangleRelation::Kind::NearEdges;
    if (start_of_b == 0 || start_of_a == 0 || starts == 0 || ends == 0) return out;
    out.kind = TriangleRelation::Kind::Crossing;
    out.above = {of_a.bits(), of_b.bits()};
    // The later start and the earlier end; turned over once, the line goes the other way.
    out.starts = starts < 0;
    out.ends = ends > 0;
    if (turned_a != turned_b) std::swap(out.starts, out.ends);
    return out;
}

}  // namespace trisect::detail
