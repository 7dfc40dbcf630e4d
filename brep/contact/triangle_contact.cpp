// SPDX-License-Identifier: Apache-2.0
//
// Triangles in different planes have in common what their intervals on the planes' common line have
// in common [Möller 1997]. An end of an interval is a corner on the line, or the point where an
// edge crosses the other plane: a point named by three planes (the triangle's, the other one's, and
// one through the edge). Comparing such points along the line is exact, so "touches in a point",
// "shares a stretch of an edge" and "passes through" are three different answers, which a version
// with rounded intervals cannot separate; and they are what matters in meshes whose neighbours
// touch everywhere.
//
// Before any of this, doubles decide nearly all pairs (contact_filter.h), and signs most others:
// all corners of one triangle on one side of the other's plane, or a shared edge and a third corner
// off the plane.
//
// Coplanar triangles are compared in a projection: their insides are disjoint iff the line of some
// edge separates them (the separating axis theorem for convex polygons in the plane).

#include <trisect/brep/contact/triangle_contact.h>

#include <algorithm>
#include <compare>
#include <optional>
#include <utility>

#include <trisect/brep/contact/contact_filter.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

using Signs = std::array<int, 3>;

// A triangle and where its corners are with respect to the other one's plane.
struct Half {
    std::array<LatticePoint, 3> p;
    Plane plane;
    Signs sign{};

    [[nodiscard]] bool is_one_sided() const {
        return (sign[0] > 0 && sign[1] > 0 && sign[2] > 0) ||
               (sign[0] < 0 && sign[1] < 0 && sign[2] < 0);
    }
    [[nodiscard]] int zeros() const {
        return (sign[0] == 0 ? 1 : 0) + (sign[1] == 0 ? 1 : 0) + (sign[2] == 0 ? 1 : 0);
    }
};

int shared_corners(const IndexedTriangle& a, const IndexedTriangle& b) {
    int n = 0;
    for (const std::uint32_t c : a)
        if (c == b[0] || c == b[1] || c == b[2]) ++n;
    return n;
}

void set_signs(Half& h, const Plane& other) {
    for (std::size_t i = 0; i < 3; ++i) h.sign[i] = sign_of(side_of(h.p[i], other));
}

struct LineInterval {
    Point low, high;
};

// The part of the triangle on the other plane. \pre some corner is on it or on each side.
LineInterval interval_on(const Half& h, const Plane& other, int axis) {
    std::array<Point, 2> ends;
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3;
        if (h.sign[i] == 0 && n < 2) ends[n++] = Point(h.p[i]);
        if (h.sign[i] * h.sign[k] < 0 && n < 2)
            ends[n++] =
                Point(h.plane, other, Plane::along_axis(h.p[i], h.p[k], h.plane.dominant_axis()));
    }
    if (n == 1) ends[1] = ends[0];
    if (compare_coordinate(ends[1], ends[0], axis) < 0) std::swap(ends[0], ends[1]);
    return {ends[0], ends[1]};
}

// A coordinate that changes along the planes' common line; -1 when they are parallel.
int line_axis(const Plane& a, const Plane& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (sign_of_cross(a, b, axis) != 0) return axis;
    return -1;
}

PairContact contact_on_line(const Half& a, const Half& b, int shared) {
    const int axis = line_axis(a.plane, b.plane);
    if (axis < 0) return {};  // parallel and, by the signs, not the same plane
    const LineInterval i = interval_on(a, b.plane, axis);
    const LineInterval k = interval_on(b, a.plane, axis);
    const Point& low = compare_coordinate(i.low, k.low, axis) < 0 ? k.low : i.low;
    const Point& high = compare_coordinate(i.high, k.high, axis) < 0 ? i.high : k.high;
    const auto order = compare_coordinate(low, high, axis);
    if (order > 0) return {};
    if (order == 0) return shared == 0 ? PairContact{ContactKind::Touch, low} : PairContact{};
    // A segment. With one shared corner, which is one of its ends, the other end is the witness.
    const bool on_edges = a.zeros() == 2 && b.zeros() == 2;
    const auto is_corner_of_both = [&](const Point& p) {
        const auto is_corner = [&](const Half& h) {
            return std::any_of(h.p.begin(), h.p.end(), [&](const LatticePoint& q) {
                return p.is_lattice() && p.lattice() == q;
            });
        };
        return is_corner(a) && is_corner(b);
    };
    return {on_edges ? ContactKind::Touch : ContactKind::Cross,
            is_corner_of_both(low) ? high : low};
}

// Coplanar triangles in a projection, both counter-clockwise.
class FlatPair {
public:
    FlatPair(const Half& a, const Half& b) : a_(a), b_(b) {
        const int axis = a.plane.dominant_axis();
        u_ = (axis + 1) % 3;
        v_ = (axis + 2) % 3;
        make_counter_clockwise(a_);
        make_counter_clockwise(b_);
    }

    [[nodiscard]] PairContact contact(int shared) const {
        // Of all edges, the best separation: corners strictly outside, outside or on, neither.
        bool insides_apart = false;
        for (const auto& [x, y] : {std::pair{&a_, &b_}, std::pair{&b_, &a_}}) {
            for (std::size_t i = 0; i < 3; ++i) {
                int most = -1;
                for (const LatticePoint& q : y->p) most = std::max(most, turn(*x, i, q));
                if (most < 0) return {};
                if (most == 0) insides_apart = true;
            }
        }
        if (insides_apart) return touch(shared);
        return {ContactKind::Overlap, common_point()};
    }

private:
    [[nodiscard]] int turn(const LatticePoint& p, const LatticePoint& q,
                           const LatticePoint& r) const {
        return exact_turn(flat_corner(p, u_, v_), flat_corner(q, u_, v_), flat_corner(r, u_, v_));
    }
    [[nodiscard]] int turn(const Half& h, std::size_t edge, const LatticePoint& q) const {
        return turn(h.p[edge], h.p[(edge + 1) % 3], q);
    }
    void make_counter_clockwise(Half& h) const {
        if (turn(h.p[0], h.p[1], h.p[2]) < 0) std::swap(h.p[1], h.p[2]);
    }
    [[nodiscard]] bool contains(const Half& h, const LatticePoint& q) const {
        return turn(h, 0, q) >= 0 && turn(h, 1, q) >= 0 && turn(h, 2, q) >= 0;
    }
    static bool is_corner(const Half& h, const LatticePoint& q) {
        return q == h.p[0] || q == h.p[1] || q == h.p[2];
    }

    // Insides disjoint: the contact is a point or a segment whose ends are corners.
    [[nodiscard]] PairContact touch(int shared) const {
        if (shared >= 2) return {};
        for (const auto& [x, y] : {std::pair{&a_, &b_}, std::pair{&b_, &a_}})
            for (const LatticePoint& q : x->p)
                if (contains(*y, q) && !(is_corner(a_, q) && is_corner(b_, q)))
                    return {ContactKind::Touch, Point(q)};
        return {};
    }

    // A corner inside the other triangle that is not shared, or else a crossing of edges. Triangles
    // with a common area have one or the other, unless all their corners are shared.
    [[nodiscard]] Point common_point() const {
        std::optional<Point> corner;
        for (const auto& [x, y] : {std::pair{&a_, &b_}, std::pair{&b_, &a_}})
            for (const LatticePoint& q : x->p)
                if (contains(*y, q)) {
                    if (!(is_corner(a_, q) && is_corner(b_, q))) return Point(q);
                    corner = Point(q);
                }
        const int axis = a_.plane.dominant_axis();
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const LatticePoint& p = a_.p[i];
                const LatticePoint& q = a_.p[(i + 1) % 3];
                const LatticePoint& r = b_.p[k];
                const LatticePoint& s = b_.p[(k + 1) % 3];
                if (turn(p, q, r) * turn(p, q, s) < 0 && turn(r, s, p) * turn(r, s, q) < 0)
                    return Point(a_.plane, Plane::along_axis(p, q, axis),
                                 Plane::along_axis(r, s, axis));
            }
        }
        TRISECT_EXPECTS(corner.has_value(), "overlapping triangles without a common point");
        return *corner;
    }

    Half a_, b_;
    int u_ = 0, v_ = 0;
};

}  // namespace

PairContact find_contact(std::span<const LatticePoint> points, const IndexedTriangle& a,
                         const IndexedTriangle& b) {
    const int shared = shared_corners(a, b);
    if (shared == 3) return {};
    if (are_plainly_apart(points, a, b, shared)) return {};
    Half x{{points[a[0]], points[a[1]], points[a[2]]}, {}, {}};
    Half y{{points[b[0]], points[b[1]], points[b[2]]}, {}, {}};
    x.plane = Plane::through(x.p[0], x.p[1], x.p[2]);
    if (shared == 2) {
        // Off the plane, the shared edge is all they have in common.
        for (std::size_t i = 0; i < 3; ++i)
            if (b[i] != a[0] && b[i] != a[1] && b[i] != a[2] &&
                side_of(y.p[i], x.plane) != Side::On)
                return {};
        y.plane = x.plane;
        return FlatPair(x, y).contact(shared);
    }
    set_signs(y, x.plane);
    if (y.is_one_sided()) return {};
    y.plane = Plane::through(y.p[0], y.p[1], y.p[2]);
    if (y.zeros() == 3) return FlatPair(x, y).contact(shared);
    // One corner shared and the others on one side: nothing more in common.
    if (shared == 1 && y.zeros() == 1 && y.sign[0] + y.sign[1] + y.sign[2] != 0) return {};
    set_signs(x, y.plane);
    if (x.is_one_sided()) return {};
    if (shared == 1 && x.zeros() == 1 && x.sign[0] + x.sign[1] + x.sign[2] != 0) return {};
    return contact_on_line(x, y, shared);
}

}  // namespace trisect::detail
