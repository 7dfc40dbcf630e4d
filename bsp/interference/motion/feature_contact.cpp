// SPDX-License-Identifier: Apache-2.0
//
// Before two moving boundaries first meet they are apart; when they do, some vertex is on a
// triangle or two edges cross (Provot 1997 for linear motion). Both need four coplanar points, a
// determinant of the motion's polynomials: its roots are the only candidates. At a root the
// features are coplanar, and whether they meet is decided in a projection along a coordinate axis
// in which their plane does not degenerate, by the signs of polynomials at the root. Floating-point
// solvers are known to fail exactly here, at coplanar and parallel features; with exact signs these
// are cases like any other:
//
//   - a triangle that is flat at the root is its three edges;
//   - parallel edges meet when an end of one is on the other;
//   - where the determinant is zero for good, everything happens in one plane, and the first
//     contact is at the start or when an orientation or a coordinate difference within the plane
//     changes its sign. All of those are collected and tried in order.

#include <trisect/bsp/interference/motion/feature_contact.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace trisect::detail {

namespace {

constexpr std::array<std::size_t, 3> axes{0, 1, 2};

// One component of a × b.
IntegerPolynomial cross_component(const PolynomialVector& a, const PolynomialVector& b,
                                  std::size_t axis) {
    const std::size_t i = next_of_three(axis);
    const std::size_t j = next_of_three(i);
    return a[i] * b[j] - a[j] * b[i];
}

// An axis along which the projection of directions a and b stays a basis, and its orientation.
struct Projection {
    std::size_t axis = 0;
    int orientation = 0;  // 0: parallel, there is no such axis
};

Projection projection_at(RealRoot& s, const PolynomialVector& a, const PolynomialVector& b) {
    for (const std::size_t axis : axes)
        if (const int sign = s.sign_of(cross_component(a, b, axis)); sign != 0) return {axis, sign};
    return {};
}

// On which side of the directed line the point is, seen along an axis.
int side_at(RealRoot& s, const PolynomialVector& direction, const PolynomialVector& from,
            const PolynomialVector& point, std::size_t axis) {
    return s.sign_of(cross_component(direction, point - from, axis));
}

bool is_zero_at(RealRoot& s, const PolynomialVector& v) {
    return std::all_of(v.begin(), v.end(),
                       [&s](const IntegerPolynomial& p) { return s.sign_of(p) == 0; });
}

// Where the ends of each edge are seen from the line of the other: products of their sides. Both
// are negative when the edges, not parallel, cross within, and none is positive when they meet.
std::array<int, 2> separations_at(RealRoot& s, const MovingEdge& a, const MovingEdge& b,
                                  std::size_t axis) {
    return {side_at(s, a.direction, a.ends[0], b.ends[0], axis) *
                side_at(s, a.direction, a.ends[0], b.ends[1], axis),
            side_at(s, b.direction, b.ends[0], a.ends[0], axis) *
                side_at(s, b.direction, b.ends[0], a.ends[1], axis)};
}

MovingEdge side(const MovingTriangle& t, std::size_t i) {
    return {{t.corners[i], t.corners[next_of_three(i)]}, t.directions[i]};
}

// The distinct roots of several polynomials in an interval.
class Times {
public:
    explicit Times(const TimeInterval& interval) : interval_(interval) {
        times_.emplace_back(interval.from);
    }
    void add(const IntegerPolynomial& p) {
        if (p.is_zero()) return;
        for (RealRoot& r : isolate_roots(p, interval_.from, interval_.to))
            times_.push_back(std::move(r));
    }
    void add(const PolynomialVector& v) {
        for (const IntegerPolynomial& p : v) add(p);
    }
    [[nodiscard]] std::vector<RealRoot> ascending() {
        std::sort(times_.begin(), times_.end(),
                  [](RealRoot a, RealRoot b) { return a.compare(b) < 0; });
        const auto same = [](RealRoot a, RealRoot b) { return a.compare(b) == 0; };
        times_.erase(std::unique(times_.begin(), times_.end(), same), times_.end());
        return std::move(times_);
    }

private:
    TimeInterval interval_;
    std::vector<RealRoot> times_;
};

void add_point_and_edge(Times& times, const PolynomialVector& point, const MovingEdge& edge) {
    times.add(cross(edge.direction, point - edge.ends[0]));
    times.add(point - edge.ends[0]);
    times.add(point - edge.ends[1]);
    times.add(edge.direction);
}

template <class A, class B>
std::optional<RealRoot> first_meeting_of(const IntegerPolynomial& coplanar, const A& a, const B& b,
                                         const TimeInterval& interval) {
    std::vector<RealRoot> times = coplanar.is_zero()
                                      ? times_of_change(a, b, interval)
                                      : isolate_roots(coplanar, interval.from, interval.to);
    for (RealRoot& s : times)
        if (meet_at(s, a, b)) return std::move(s);
    return std::nullopt;
}

}  // namespace

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
    return {cross_component(a, b, 0), cross_component(a, b, 1), cross_component(a, b, 2)};
}

IntegerPolynomial dot(const PolynomialVector& a, const PolynomialVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

MovingEdge moving_edge(const PolynomialVector& a, const PolynomialVector& b) {
    return {{a, b}, b - a};
}

MovingTriangle moving_triangle(const PolynomialVector& a, const PolynomialVector& b,
                               const PolynomialVector& c) {
    return {{a, b, c}, {b - a, c - b, a - c}};
}

bool meet_at(RealRoot& s, const PolynomialVector& point, const MovingEdge& edge) {
    // A point counts as on the edge when it is on its line and between its ends in a coordinate in
    // which they differ.
    for (const std::size_t axis : axes)
        if (side_at(s, edge.direction, edge.ends[0], point, axis) != 0) return false;
    for (const std::size_t i : axes) {
        const int length = s.sign_of(edge.direction[i]);
        if (length == 0) continue;
        return length * s.sign_of(point[i] - edge.ends[0][i]) >= 0 &&
               length * s.sign_of(point[i] - edge.ends[1][i]) <= 0;
    }
    return is_zero_at(s, point - edge.ends[0]);
}

bool meet_at(RealRoot& s, const PolynomialVector& point, const MovingTriangle& triangle) {
    const Projection projection = projection_at(s, triangle.directions[0], triangle.directions[1]);
    if (projection.orientation == 0) {
        return std::any_of(axes.begin(), axes.end(),
                           [&](std::size_t i) { return meet_at(s, point, side(triangle, i)); });
    }
    return std::all_of(axes.begin(), axes.end(), [&](std::size_t i) {
        return projection.orientation * side_at(s, triangle.directions[i], triangle.corners[i],
                                                point, projection.axis) >=
               0;
    });
}

bool meet_at(RealRoot& s, const MovingEdge& a, const MovingEdge& b) {
    const Projection projection = projection_at(s, a.direction, b.direction);
    if (projection.orientation != 0) {
        const auto separation = separations_at(s, a, b, projection.axis);
        return separation[0] <= 0 && separation[1] <= 0;
    }
    return meet_at(s, a.ends[0], b) || meet_at(s, a.ends[1], b) || meet_at(s, b.ends[0], a) ||
           meet_at(s, b.ends[1], a);
}

std::array<int, 3> sides_at(RealRoot& s, const PolynomialVector& point,
                            const MovingTriangle& triangle) {
    const Projection projection = projection_at(s, triangle.directions[0], triangle.directions[1]);
    std::array<int, 3> sides{};
    for (const std::size_t i : axes)
        sides[i] = projection.orientation *
                   side_at(s, triangle.directions[i], triangle.corners[i], point, projection.axis);
    return sides;
}

bool cross_within_at(RealRoot& s, const MovingEdge& a, const MovingEdge& b) {
    const Projection projection = projection_at(s, a.direction, b.direction);
    if (projection.orientation == 0) return false;
    const auto separation = separations_at(s, a, b, projection.axis);
    return separation[0] < 0 && separation[1] < 0;
}

IntegerPolynomial coplanarity(const PolynomialVector& point, const MovingTriangle& triangle) {
    return dot(cross(triangle.directions[0], triangle.directions[1]), point - triangle.corners[0]);
}

IntegerPolynomial coplanarity(const MovingEdge& a, const MovingEdge& b) {
    return dot(cross(a.direction, b.direction), b.ends[0] - a.ends[0]);
}

std::vector<RealRoot> times_of_change(const PolynomialVector& point, const MovingTriangle& triangle,
                                      const TimeInterval& interval) {
    Times times(interval);
    times.add(cross(triangle.directions[0], triangle.directions[1]));
    for (const std::size_t i : axes) add_point_and_edge(times, point, side(triangle, i));
    return times.ascending();
}

std::vector<RealRoot> times_of_change(const MovingEdge& a, const MovingEdge& b,
                                      const TimeInterval& interval) {
    Times times(interval);
    times.add(cross(a.direction, b.direction));
    for (const PolynomialVector& p : a.ends) add_point_and_edge(times, p, b);
    for (const PolynomialVector& p : b.ends) add_point_and_edge(times, p, a);
    return times.ascending();
}

std::optional<RealRoot> first_meeting(const IntegerPolynomial& coplanar,
                                      const PolynomialVector& point, const MovingTriangle& triangle,
                                      const TimeInterval& interval) {
    return first_meeting_of(coplanar, point, triangle, interval);
}

std::optional<RealRoot> first_meeting(const IntegerPolynomial& coplanar, const MovingEdge& a,
                                      const MovingEdge& b, const TimeInterval& interval) {
    return first_meeting_of(coplanar, a, b, interval);
}

}  // namespace trisect::detail
