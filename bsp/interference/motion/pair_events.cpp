// SPDX-License-Identifier: Apache-2.0
//
// Every condition is linear in one of the maps of the relative motion: the height of a vertex over
// a plane, the height of a plane over a vertex, the product of two lines (Plücker). So are the
// conditions of meeting: a vertex is beyond a side of a triangle when it is beyond the plane
// through that side and the triangle's normal; edges miss each other when the ends of one are on
// one side of the other one's line, seen along any axis. Their Bernstein coefficients over an
// interval are sums of a few products in doubles with error bounds (Ball). An interval without a
// root, or without meeting, is dropped; another one is halved, the numbers with it, down to a
// thousandth part. What is left is decided by integer polynomials (feature_contact.h).
//
// Features that slide in one plane are coplanar all the time, which no halving shows: a thousand
// parts would be made for each pair of a peg in its hole. So where all coefficients may be zero the
// polynomial is computed at once.

#include <trisect/bsp/interference/motion/pair_events.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <trisect/bsp/interference/moving_points.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// How often an interval is halved before exact numbers decide.
constexpr int max_halvings = 10;

BallVector normal_ball(const Plane& p) {
    return {Ball::rounded(p.approx_normal(0)), Ball::rounded(p.approx_normal(1)),
            Ball::rounded(p.approx_normal(2))};
}

// A plane in doubles.
struct BallPlane {
    BallVector normal;
    Ball offset;
};

// The image of B's point, and its weight, at one Bernstein coefficient.
BallVector moved_point(const BallMotion::Maps& m, const BallVector& x) {
    return m.matrix * x + m.shift;
}

// B's plane over a point of A.
Ball height_over(const BallMotion::Maps& m, const BallPlane& plane, const BallVector& x) {
    return dot(m.plane_normal * plane.normal, x) +
           (m.plane_offset * plane.offset - dot(m.plane_shift, plane.normal));
}

bool may_vanish(const BallPolynomial& p, std::size_t degree) {
    return std::all_of(p.b.begin(), p.b.begin() + static_cast<std::ptrdiff_t>(degree) + 1,
                       [](const Ball& b) { return b.sign() == 0; });
}

using BallCorners = EventModel::Corners;

// The plane through side i and the normal; inside is above.
BallPlane side_plane(const BallCorners& c, const BallVector& normal, std::size_t i) {
    const BallVector n = cross(normal, c[next_of_three(i)] - c[i]);
    return {n, -dot(n, c[i])};
}

std::size_t dominant_axis(const BallVector& v) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(v[i].value) > std::abs(v[axis].value)) axis = i;
    return axis;
}

}  // namespace

// The coplanarity and the conditions of meeting over one interval.
struct PairEvents::Scalars {
    BallPolynomial coplanar;
    std::array<BallPolynomial, 4> conditions;
    std::size_t count = 3;

    // Vertex and face: beyond a side for good. Two edges: conditions 0 and 1 are the ends of one
    // seen from the other, 2 and 3 the other way round.
    [[nodiscard]] bool never_meet(Kind kind, std::size_t degree) const {
        if (kind != Kind::EdgeEdge)
            return std::any_of(conditions.begin(), conditions.begin() + 3,
                               [degree](const auto& c) { return constant_sign(c, degree) < 0; });
        for (std::size_t i = 0; i < 4; i += 2) {
            const int s = constant_sign(conditions[i], degree);
            if (s != 0 && s == constant_sign(conditions[i + 1], degree)) return true;
        }
        return false;
    }
};

// What the questions of all triangles of A have in common: a triangle of B on its way.
struct PairEvents::Moved {
    using Path = std::array<BallVector, BallPolynomial::max_degree + 1>;

    std::uint32_t triangle = 0xffffffffU;
    double from = 0;
    double to = 0;
    BallCorners at_rest;
    BallVector normal_at_rest;
    std::array<Path, 3> corner;
    Path normal;
    std::array<Ball, BallPolynomial::max_degree + 1> offset;
    // Of the sides.
    std::array<Path, 3> direction;
    std::array<Path, 3> moment;
};

// A triangle of A, which is the one at rest.
struct PairEvents::Resting {
    BallCorners corner;
    BallVector normal;
    Ball offset;

    Resting(const EventModel& model, std::uint32_t t) : corner(model.corners(t)) {
        const Plane& plane = model.plane(t);
        normal = normal_ball(plane);
        offset = Ball::rounded(plane.approx_offset());
    }
};

PairEvents::PairEvents(const EventModel& a, const EventModel& b, const RelativeMotion& motion)
    : a_(a), b_(b), motion_(motion), moved_(std::make_unique<Moved>()) {}

PairEvents::~PairEvents() = default;

const PairEvents::Moved& PairEvents::moved(std::uint32_t triangle_b, const BallMotion& over) {
    Moved& r = *moved_;
    if (r.triangle == triangle_b && r.from == over.from && r.to == over.to) return r;
    r.triangle = triangle_b;
    r.from = over.from;
    r.to = over.to;
    const Plane& plane = b_.plane(triangle_b);
    r.at_rest = b_.corners(triangle_b);
    r.normal_at_rest = normal_ball(plane);
    const Ball offset = Ball::rounded(plane.approx_offset());
    for (std::size_t k = 0; k <= over.degree; ++k) {
        const BallMotion::Maps& m = over.maps[k];
        r.normal[k] = m.plane_normal * r.normal_at_rest;
        r.offset[k] = m.plane_offset * offset - detail::dot(m.plane_shift, r.normal_at_rest);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const BallVector u = r.at_rest[next_of_three(i)] - r.at_rest[i];
        const BallVector moment = detail::cross(r.at_rest[i], r.at_rest[next_of_three(i)]);
        for (std::size_t k = 0; k <= over.degree; ++k) {
            const BallMotion::Maps& m = over.maps[k];
            r.corner[i][k] = moved_point(m, r.at_rest[i]);
            if (!b_.owns_edge(triangle_b, i)) continue;
            r.direction[i][k] = m.line_direction * u;
            r.moment[i][k] = m.line_moment * moment + m.line_lever * u;
        }
    }
    return r;
}

void PairEvents::find(std::uint32_t triangle_a, std::uint32_t triangle_b, const BallMotion& over,
                      EarliestEvents& events) {
    if (over.from > events.latest()) return;
    const Moved& b = moved(triangle_b, over);
    const Resting a(a_, triangle_a);

    // All corners of one for good on one side of the plane of the other: nothing can happen.
    std::array<BallPolynomial, 3> b_over_a;
    std::array<BallPolynomial, 3> a_over_b;
    std::array<int, 3> side_of_b{};
    std::array<int, 3> side_of_a{};
    const auto all_on_one_side = [](const std::array<int, 3>& s) {
        return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
    };
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k <= over.degree; ++k)
            b_over_a[i].b[k] =
                detail::dot(a.normal, b.corner[i][k]) + a.offset * over.maps[k].weight;
        side_of_b[i] = constant_sign(b_over_a[i], over.degree);
    }
    if (all_on_one_side(side_of_b)) return;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k <= over.degree; ++k)
            a_over_b[i].b[k] = detail::dot(b.normal[k], a.corner[i]) + b.offset[k];
        side_of_a[i] = constant_sign(a_over_b[i], over.degree);
    }
    if (all_on_one_side(side_of_a)) return;

    for (std::size_t i = 0; i < 3; ++i) {
        if (b_.owns_vertex(triangle_b, i)) {
            ++detail::counters_of_thread<MotionCounters>.questions;
            if (side_of_b[i] == 0)
                vertex_of_b({Kind::VertexFace, triangle_a, triangle_b, 0, i}, a, b_over_a[i], over,
                            events);
            else
                ++detail::counters_of_thread<MotionCounters>.filtered;
        }
        if (a_.owns_vertex(triangle_a, i)) {
            ++detail::counters_of_thread<MotionCounters>.questions;
            if (side_of_a[i] == 0)
                vertex_of_a({Kind::FaceVertex, triangle_a, triangle_b, i, 0}, a, a_over_b[i], over,
                            events);
            else
                ++detail::counters_of_thread<MotionCounters>.filtered;
        }
        if (!a_.owns_edge(triangle_a, i)) continue;
        for (std::size_t j = 0; j < 3; ++j)
            if (b_.owns_edge(triangle_b, j))
                edges({Kind::EdgeEdge, triangle_a, triangle_b, i, j}, a, over, events);
    }
}

void PairEvents::vertex_of_b(const Features& f, const Resting& a, const BallPolynomial& height,
                             const BallMotion& over, EarliestEvents& events) {
    Scalars scalars;
    scalars.coplanar = height;
    for (std::size_t i = 0; i < 3; ++i) {
        const BallPlane s = side_plane(a.corner, a.normal, i);
        for (std::size_t k = 0; k <= over.degree; ++k)
            scalars.conditions[i].b[k] =
                detail::dot(s.normal, moved_->corner[f.j][k]) + s.offset * over.maps[k].weight;
    }
    narrow(f, over, scalars, events);
}

void PairEvents::vertex_of_a(const Features& f, const Resting& a, const BallPolynomial& height,
                             const BallMotion& over, EarliestEvents& events) {
    Scalars scalars;
    scalars.coplanar = height;
    for (std::size_t i = 0; i < 3; ++i) {
        const BallPlane s = side_plane(moved_->at_rest, moved_->normal_at_rest, i);
        for (std::size_t k = 0; k <= over.degree; ++k)
            scalars.conditions[i].b[k] = height_over(over.maps[k], s, a.corner[f.i]);
    }
    narrow(f, over, scalars, events);
}

void PairEvents::edges(const Features& f, const Resting& a, const BallMotion& over,
                       EarliestEvents& events) {
    ++detail::counters_of_thread<MotionCounters>.questions;
    const Moved& b = *moved_;
    const BallVector& a0 = a.corner[f.i];
    const BallVector& a1 = a.corner[next_of_three(f.i)];
    const BallVector ua = a1 - a0;
    const BallVector ma = detail::cross(a0, a1);
    const Moved::Path& direction = b.direction[f.j];
    const Moved::Path& moment = b.moment[f.j];
    Scalars scalars;
    for (std::size_t k = 0; k <= over.degree; ++k)
        scalars.coplanar.b[k] = detail::dot(ua, moment[k]) + detail::dot(ma, direction[k]);
    if (constant_sign(scalars.coplanar, over.degree) != 0) {
        ++detail::counters_of_thread<MotionCounters>.filtered;
        return;
    }
    scalars.count = 4;
    const std::size_t axis = dominant_axis(detail::cross(ua, direction[0]));
    for (std::size_t k = 0; k <= over.degree; ++k) {
        scalars.conditions[0].b[k] = detail::cross(a0, direction[k])[axis] - moment[k][axis];
        scalars.conditions[1].b[k] = detail::cross(a1, direction[k])[axis] - moment[k][axis];
        const Ball lift = ma[axis] * over.maps[k].weight;
        scalars.conditions[2].b[k] = detail::cross(b.corner[f.j][k], ua)[axis] - lift;
        scalars.conditions[3].b[k] =
            detail::cross(b.corner[next_of_three(f.j)][k], ua)[axis] - lift;
    }
    narrow(f, over, scalars, events);
}

void PairEvents::narrow(const Features& f, const BallMotion& over, const Scalars& scalars,
                        EarliestEvents& events) {
    if (may_vanish(scalars.coplanar, over.degree) && !scalars.never_meet(f.kind, over.degree) &&
        are_coplanar_for_good(f))
        return;
    struct Part {
        Scalars scalars;
        double from = 0;
        double to = 1;
        int halvings = 0;
    };
    // What doubles leave over, neighbouring parts joined.
    double left_from = 2;
    double left_to = 0;
    const auto decide_left = [&] {
        if (left_from < left_to) decide(f, {mpq_class(left_from), mpq_class(left_to)}, events);
        left_from = 2;
    };
    std::array<Part, max_halvings + 2> parts;
    std::size_t size = 1;
    parts[0] = {scalars, over.from, over.to, 0};
    bool any = false;
    while (size > 0) {
        const Part part = parts[--size];
        if (part.from > events.latest()) break;
        if (part.to < events.earliest()) continue;
        if (constant_sign(part.scalars.coplanar, over.degree) != 0 ||
            part.scalars.never_meet(f.kind, over.degree))
            continue;
        any = true;
        if (part.halvings == max_halvings) {
            if (left_from < left_to && left_to != part.from) decide_left();
            left_from = std::min(left_from, part.from);
            left_to = part.to;
            continue;
        }
        const double middle = (part.from + part.to) / 2;
        Part& right = parts[size++];
        Part& left = parts[size++];
        halve(part.scalars.coplanar, over.degree, left.scalars.coplanar, right.scalars.coplanar);
        for (std::size_t i = 0; i < part.scalars.count; ++i)
            halve(part.scalars.conditions[i], over.degree, left.scalars.conditions[i],
                  right.scalars.conditions[i]);
        left.scalars.count = right.scalars.count = part.scalars.count;
        left.from = part.from;
        left.to = right.from = middle;
        right.to = part.to;
        left.halvings = right.halvings = part.halvings + 1;
    }
    if (left_from < left_to)
        decide_left();
    else if (!any)
        ++detail::counters_of_thread<MotionCounters>.filtered;
}

}  // namespace trisect::detail
