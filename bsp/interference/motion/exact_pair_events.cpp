// SPDX-License-Identifier: Apache-2.0
//
// The exact stage of PairEvents: coplanarity as an integer polynomial, and the signs at its roots
// that say whether the features meet there (feature_contact.h).

#include <trisect/bsp/interference/motion/pair_events.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/motion/exact_paths.h>
#include <trisect/bsp/interference/moving_points.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

IntegerPolynomial combined(const PolynomialVector& a, const MpzVector& b) {
    IntegerPolynomial r;
    for (std::size_t i = 0; i < 3; ++i) r.add_multiple(a[i], b[i]);
    return r;
}

MpzVector exact_normal(const Plane& p) {
    return {to_gmp(p.normal(0)), to_gmp(p.normal(1)), to_gmp(p.normal(2))};
}

struct MovingVertexAndTriangle {
    PolynomialVector point;
    MovingTriangle triangle;
};

// Point 0 against the triangle of points 1 to 3.
MovingVertexAndTriangle vertex_and_triangle(const RelativeMotion& motion, const ExactPoints& points,
                                            bool triangle_moves) {
    MovingVertexAndTriangle r;
    r.point = triangle_moves ? resting_path(motion, points, 0) : moving_path(motion, points, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        r.triangle.corners[i] = triangle_moves ? moving_path(motion, points, i + 1)
                                               : resting_path(motion, points, i + 1);
        const MpzVector d = difference(points.xyz[next_of_three(i) + 1], points.xyz[i + 1]);
        r.triangle.directions[i] = triangle_moves ? times(motion.point.matrix, d) : constant(d);
    }
    return r;
}

}  // namespace

void PairEvents::find_exactly(std::uint32_t triangle_a, std::uint32_t triangle_b,
                              const TimeInterval& interval, EarliestEvents& events) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (b_.owns_vertex(triangle_b, i))
            decide({Kind::VertexFace, triangle_a, triangle_b, 0, i}, interval, events);
        if (a_.owns_vertex(triangle_a, i))
            decide({Kind::FaceVertex, triangle_a, triangle_b, i, 0}, interval, events);
        if (!a_.owns_edge(triangle_a, i)) continue;
        for (std::size_t j = 0; j < 3; ++j)
            if (b_.owns_edge(triangle_b, j))
                decide({Kind::EdgeEdge, triangle_a, triangle_b, i, j}, interval, events);
    }
}

IntegerPolynomial PairEvents::coplanarity_of(const Features& f) const {
    const std::uint32_t ta = f.triangle_a;
    const std::uint32_t tb = f.triangle_b;
    ExactPoints points;
    if (f.kind == Kind::VertexFace) {
        points.add(b_.point(tb, f.j));
        const Plane& plane = a_.plane(ta);
        IntegerPolynomial r = combined(moving_path(motion_, points, 0), exact_normal(plane));
        r.add_multiple(motion_.point.weight, to_gmp(plane.offset()) * points.weight);
        return r;
    }
    if (f.kind == Kind::FaceVertex) {
        points.add(a_.point(ta, f.i));
        const Plane& plane = b_.plane(tb);
        const MpzVector normal = exact_normal(plane);
        IntegerPolynomial r = combined(times(motion_.plane_normal, normal), points.xyz[0]);
        IntegerPolynomial offset = motion_.plane_offset * to_gmp(plane.offset());
        offset -= combined(motion_.plane_shift, normal);
        r.add_multiple(offset, points.weight);
        return r;
    }
    points.add(a_.point(ta, f.i));
    points.add(a_.point(ta, next_of_three(f.i)));
    ExactPoints of_b;
    of_b.add(b_.point(tb, f.j));
    of_b.add(b_.point(tb, next_of_three(f.j)));
    // The line through x / w and y / w: direction w (y - x), moment x × y, both times 1 / w^2.
    const auto direction = [](const ExactPoints& p) {
        MpzVector u = difference(p.xyz[1], p.xyz[0]);
        for (mpz_class& c : u) c *= p.weight;
        return u;
    };
    const MpzVector ub = direction(of_b);
    const MpzVector mb = cross(of_b.xyz[0], of_b.xyz[1]);
    PolynomialVector moment = times(motion_.line_moment, mb);
    const PolynomialVector lever = times(motion_.line_lever, ub);
    for (std::size_t i = 0; i < 3; ++i) moment[i] += lever[i];
    return combined(moment, direction(points)) +
           combined(times(motion_.line_direction, ub), cross(points.xyz[0], points.xyz[1]));
}

bool PairEvents::are_coplanar_for_good(const Features& f) const {
    if (!coplanarity_of(f).is_zero()) return false;
    MotionCounters& counters = detail::counters_of_thread<MotionCounters>;
    ++counters.exact;
    ++counters.coplanar;
    return true;
}

void PairEvents::decide(const Features& f, const TimeInterval& interval, EarliestEvents& events) {
    MotionCounters& counters = detail::counters_of_thread<MotionCounters>;
    ++counters.exact;
    const IntegerPolynomial p = coplanarity_of(f);
    if (p.is_zero()) {
        ++counters.coplanar;
        return;
    }
    for (RealRoot& s : isolate_roots(p, interval.from, interval.to)) add_if_they_meet(f, s, events);
}

void PairEvents::add_if_they_meet(const Features& f, RealRoot& s, EarliestEvents& events) {
    const std::uint32_t ta = f.triangle_a;
    const std::uint32_t tb = f.triangle_b;
    ExactPoints points;
    FeaturePair pair;
    if (f.kind == Kind::EdgeEdge) {
        points.add(a_.point(ta, f.i));
        points.add(a_.point(ta, next_of_three(f.i)));
        points.add(b_.point(tb, f.j));
        points.add(b_.point(tb, next_of_three(f.j)));
        const MovingEdge a{{resting_path(motion_, points, 0), resting_path(motion_, points, 1)},
                           constant(difference(points.xyz[1], points.xyz[0]))};
        const MovingEdge b{{moving_path(motion_, points, 2), moving_path(motion_, points, 3)},
                           times(motion_.point.matrix, difference(points.xyz[3], points.xyz[2]))};
        if (!cross_within_at(s, a, b)) return;
        pair = {FeaturePair::Kind::Edges, {ta, Feature::side(f.i)}, {tb, Feature::side(f.j)}};
    } else {
        const bool of_b = f.kind == Kind::VertexFace;
        const std::uint32_t tv = of_b ? tb : ta;
        const std::uint32_t tf = of_b ? ta : tb;
        const std::size_t i = of_b ? f.j : f.i;
        points.add((of_b ? b_ : a_).point(tv, i));
        for (std::size_t k = 0; k < 3; ++k) points.add((of_b ? a_ : b_).point(tf, k));
        const MovingVertexAndTriangle m = vertex_and_triangle(motion_, points, !of_b);
        const std::optional<Feature> at = feature_from_signs(sides_at(s, m.point, m.triangle));
        if (!at) return;
        const ContactFeature vertex{tv, Feature::corner(i)};
        const ContactFeature face{tf, *at};
        pair = of_b ? FeaturePair{FeaturePair::Kind::VertexOfB, face, vertex}
                    : FeaturePair{FeaturePair::Kind::VertexOfA, vertex, face};
    }
    ++detail::counters_of_thread<MotionCounters>.contacts;
    events.add(s, pair);
}

}  // namespace trisect::detail
