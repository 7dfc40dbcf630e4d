// SPDX-License-Identifier: Apache-2.0
//
// Cutting a convex polygon without constructing a coordinate.
//
// The naive way keeps vertices as coordinates and computes a new vertex where an edge crosses the
// cutting plane. Rounded, that vertex lies on neither the edge nor the plane, and the next cut
// decides against a polygon that is not the original one; exact, its coordinates grow with every
// cut. Bernstein and Fussell (2009, sec. 3) keep the planes instead: a vertex is where the support
// meets two consecutive edge planes, and a cut merely inserts the cutting plane into the cyclic
// list of edges.
//
// What becomes of the list follows from the signs of three consecutive vertices. Around a strictly
// convex polygon the signs form one run of Below and one run of Above; between the runs lies either
// a single vertex that is On, or an edge whose two ends have opposite signs. So for the part below:
//
//     - - ?    both ends of the edge are Below: the edge stays as it is;
//     - + ?    the edge is crossed: it stays, and the new edge follows it;
//     - 0 +    the plane passes through its end: it stays, the new edge follows it, and the next
//              edge, which only touches, is dropped;
//     0 0 -    the plane holds an edge: there is nothing on its other side, hence no cut.
//
// Read from the other side the same rules give the part above. Two vertices can be On without being
// neighbours (a cut through two corners); each is then treated by the third rule. A piece cannot
// come out without area, because it inherits a vertex that is strictly on its side and the new edge
// has two different ends.
//
// Where we differ: signs are computed for the vertices as points that carry certified doubles, so
// that nearly all of them are decided by the filter; and a vertex through which a cut passes is
// kept under the name it had, which saves an intersection.

#include <trisect/kernel/convex_polygon.h>

#include <array>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

/// Where the boundary, walked counter-clockwise, passes from one side of a plane to the other.
struct ConvexPolygon::Crossing {
    std::size_t last;   ///< the last edge with a part on the side that is left
    std::size_t first;  ///< the first edge with a part on the side that is entered
    Point point;
};

namespace {

bool is_plane_or_flip(const Plane& a, const Plane& b) {
    return a == b || (a.normal(0) == -b.normal(0) && a.normal(1) == -b.normal(1) &&
                      a.normal(2) == -b.normal(2) && a.offset() == -b.offset());
}

}  // namespace

ConvexPolygon::ConvexPolygon(const Plane& support, std::vector<Plane> edges,
                             std::vector<Point> vertices)
    : support_(support), edges_(std::move(edges)), vertices_(std::move(vertices)) {
    TRISECT_AUDIT_CHECK(is_consistent(), "convex polygon breaks its invariants");
}

ConvexPolygon::ConvexPolygon(const Plane& support, std::vector<Plane> edges)
    : support_(support), edges_(std::move(edges)) {
    TRISECT_EXPECTS(edges_.size() >= 3, "convex polygon with less than three edges");
    vertices_.reserve(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i)
        vertices_.emplace_back(support_, edges_[i == 0 ? edges_.size() - 1 : i - 1], edges_[i]);
    TRISECT_AUDIT_CHECK(is_consistent(), "convex polygon breaks its invariants");
}

ConvexPolygon ConvexPolygon::from_triangle(const LatticePoint& a, const LatticePoint& b,
                                           const LatticePoint& c) {
    const std::array<LatticePoint, 3> corners{a, b, c};
    return from_corners(Plane::through(a, b, c), corners);
}

ConvexPolygon ConvexPolygon::from_corners(const Plane& support,
                                          std::span<const LatticePoint> corners) {
    TRISECT_EXPECTS(corners.size() >= 3, "convex polygon with less than three corners");
    // Seen along the dominant axis the polygon does not degenerate. (b - a) × e points to the right
    // of the edge, which is outside, when e points up from the support.
    const int axis = support.dominant_axis();
    const bool upward = support.normal(axis) > 0;
    std::vector<Plane> edges;
    std::vector<Point> vertices;
    edges.reserve(corners.size());
    vertices.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const LatticePoint& a = corners[i];
        const LatticePoint& b = corners[i + 1 < corners.size() ? i + 1 : 0];
        edges.push_back(upward ? Plane::along_axis(a, b, axis) : Plane::along_axis(b, a, axis));
        vertices.emplace_back(a);
    }
    return {support, std::move(edges), std::move(vertices)};
}

Side ConvexPolygon::side_of_vertex(std::size_t i, const Plane& plane) const {
    const Point& v = vertices_[i];
    if (!v.is_lattice()) {
        auto& counters = detail::counters_of_thread<PredicateCounters>;
        if (const auto s = filtered_side(v.approximation(), plane)) {
            ++counters.filtered;
            return *s;
        }
        // Beside its own name a vertex has that of its place in the polygon, in either orientation.
        const Plane& before = edges_[i == 0 ? edges_.size() - 1 : i - 1];
        if (is_plane_or_flip(plane, before) || is_plane_or_flip(plane, edges_[i]) ||
            is_plane_or_flip(plane, support_)) {
            ++counters.symbolic;
            return Side::On;
        }
    }
    return side_of(v, plane);
}

ConvexPolygon::Classification ConvexPolygon::sides_of_vertices(const Plane& plane,
                                                               std::vector<Side>& sides) const {
    Classification counts;
    sides.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) {
        sides.push_back(side_of_vertex(i, plane));
        ++(sides.back() == Side::Below ? counts.below
                                       : (sides.back() == Side::On ? counts.on : counts.above));
    }
    return counts;
}

ConvexPolygon::Classification ConvexPolygon::classify(const Plane& plane) const {
    Classification counts;
    for (std::size_t i = 0; i < size(); ++i) {
        const Side s = side_of_vertex(i, plane);
        ++(s == Side::Below ? counts.below : (s == Side::On ? counts.on : counts.above));
    }
    return counts;
}

// The one place where the boundary leaves the side `from`. \pre the plane cuts the polygon.
ConvexPolygon::Crossing ConvexPolygon::crossing(const Plane& plane, const std::vector<Side>& sides,
                                                Side from) const {
    std::size_t i = 0;
    std::size_t next = 1;
    while (!(sides[i] == from && sides[next] != from)) {
        TRISECT_EXPECTS(i + 1 < size(), "a cut polygon has no place where its boundary crosses");
        ++i;
        next = i + 1 < size() ? i + 1 : 0;
    }
    if (sides[next] == Side::On) return {i, next, vertices_[next]};
    return {i, i, Point(support_, plane, edges_[i])};
}

// The edges from the one that is entered first to the one that is left last, closed by a new edge.
ConvexPolygon ConvexPolygon::part(const Crossing& enter, const Crossing& leave,
                                  const Plane& closing) const {
    std::vector<Plane> edges;
    std::vector<Point> vertices;
    const std::size_t n = size();
    const std::size_t kept = (leave.last + n - enter.first) % n + 1;
    edges.reserve(kept + 1);
    vertices.reserve(kept + 1);
    for (std::size_t k = 0; k < kept; ++k) {
        const std::size_t i = (enter.first + k) % n;
        edges.push_back(edges_[i]);
        vertices.push_back(k == 0 ? enter.point : vertices_[i]);
    }
    edges.push_back(closing);
    vertices.push_back(leave.point);
    return {support_, std::move(edges), std::move(vertices)};
}

ConvexPolygon::Classification ConvexPolygon::split(const Plane& plane, ConvexPolygon& below,
                                                   ConvexPolygon& above) const {
    std::vector<Side> sides;
    const Classification counts = sides_of_vertices(plane, sides);
    if (!counts.is_cut()) return counts;
    const Crossing up = crossing(plane, sides, Side::Below);
    const Crossing down = crossing(plane, sides, Side::Above);
    ConvexPolygon lower = part(down, up, plane);
    ConvexPolygon upper = part(up, down, plane.flipped());
    below = std::move(lower);
    above = std::move(upper);
    return counts;
}

ConvexPolygon ConvexPolygon::clip_below(const Plane& plane) const {
    std::vector<Side> sides;
    const Classification counts = sides_of_vertices(plane, sides);
    if (counts.above == 0) return *this;
    if (counts.below == 0) return {};
    return part(crossing(plane, sides, Side::Above), crossing(plane, sides, Side::Below), plane);
}

ConvexPolygon ConvexPolygon::clip_above(const Plane& plane) const {
    return clip_below(plane.flipped());
}

ConvexPolygon ConvexPolygon::flipped() const {
    if (is_empty()) return {};
    const std::size_t n = size();
    std::vector<Plane> edges(edges_.rbegin(), edges_.rend());
    std::vector<Point> vertices;
    vertices.reserve(n);
    for (std::size_t i = 0; i < n; ++i) vertices.push_back(vertices_[(n - i) % n]);
    return {support_.flipped(), std::move(edges), std::move(vertices)};
}

bool ConvexPolygon::is_consistent() const {
    const std::size_t n = size();
    if (n == 0) return vertices_.empty();
    if (n < 3 || vertices_.size() != n) return false;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = i == 0 ? n - 1 : i - 1;
        // Outward normals turn counter-clockwise around the support's normal.
        if (sign_of_det(support_, edges_[before], edges_[i]) <= 0) return false;
        if (side_of(vertices_[i], support_) != Side::On) return false;
        for (std::size_t k = 0; k < n; ++k) {
            const Side expected = k == before || k == i ? Side::On : Side::Below;
            if (side_of(vertices_[i], edges_[k]) != expected) return false;
        }
    }
    return true;
}

}  // namespace trisect
