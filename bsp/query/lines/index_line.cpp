// SPDX-License-Identifier: Apache-2.0
//
// A line o + t d against a triangle a, b, c: with the determinants e = d · ((a - o) × (b - o)) and
// so on around the triangle, the line meets its interior when all three have one sign, and then
// t = N · (a - o) / N · d, with the bounds of error_bounds.h (difference_determinant_rounding).
//
// What doubles cannot decide is decided by planes in rationals: a line meets a convex polygon where
// it meets the support between its edges, or, when it runs in the support, from the last edge that
// it enters by to the first one that it leaves by. Such a parameter is where the line meets a
// plane.

#include <trisect/bsp/query/lines/index_line.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/query/index/line_through.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/plane_value.h>

namespace trisect {

namespace {

ExactRational exact_coordinate(double v, int exponent) {
    return ExactRational::from_double(v).scaled(-exponent);
}

}  // namespace

RayParameter::RayParameter(const Ray& ray, int exponent, const Plane& plane)
    : form_(Form::Ray),
      exponent_(exponent),
      origin_(ray.origin),
      towards_(ray.direction),
      plane_(plane) {
    approximate_value();
}

RayParameter::RayParameter(const Segment& segment, int exponent, const Plane& plane)
    : form_(Form::Segment),
      exponent_(exponent),
      origin_(segment.from),
      towards_(segment.to),
      plane_(plane) {
    approximate_value();
}

void RayParameter::approximate_value() {
    // t = -(n · o + d) / (n · direction), in the user's units: n · (o 2^-e) and so on.
    const double scale = exponent_ == 0 ? 1.0 : std::ldexp(1.0, -exponent_);
    double at = plane_.approx_offset();
    double at_terms = std::fabs(at);
    double slope = 0;
    double slope_terms = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double n = plane_.approx_normal(static_cast<int>(k));
        const double o = n * (origin_[k] * scale);
        const double step = form_ == Form::Ray ? towards_[k] : towards_[k] - origin_[k];
        const double d = n * (step * scale);
        at += o;
        at_terms += std::fabs(o);
        slope += d;
        slope_terms += std::fabs(d);
    }
    const double at_error = 0x1p-50 * at_terms;
    const double slope_error = 0x1p-50 * slope_terms;
    // With scaled coefficients tiny terms may have lost digits, or all of them.
    const bool is_tiny = plane_.tier() > 1 &&
                         (slope_terms < 0x1p-900 || (at_terms < 0x1p-900 && origin_ != Point3d{}));
    const double safe = std::fabs(slope) - slope_error;
    value_ = -at / slope;
    error_ = ((at_error + std::fabs(value_) * slope_error) / safe) * detail::bound_slack +
             std::fabs(value_) * detail::last_place;
    if (!(safe > 0.75 * std::fabs(slope)) || !(error_ < HUGE_VAL) || is_tiny ||
        !(scale > 0x1p-900 && scale < 0x1p900)) {
        const ExactRational t = exact();
        value_ = t.to_double();
        error_ = std::fabs(value_) * detail::last_place + 0x1p-1000;
        if (!std::isfinite(value_)) {
            value_ = std::copysign(std::numeric_limits<double>::max(), value_);
            error_ = HUGE_VAL;
        }
    }
}

RayParameter RayParameter::infinite() {
    RayParameter t;
    t.value_ = std::numeric_limits<double>::infinity();
    t.form_ = Form::Infinite;
    return t;
}

ExactRational RayParameter::exact() const {
    if (form_ == Form::Number) return ExactRational::from_double(value_);
    ExactRational at(plane_.offset());
    ExactRational slope;
    for (std::size_t k = 0; k < 3; ++k) {
        const ExactRational n(plane_.normal(static_cast<int>(k)));
        const ExactRational o = exact_coordinate(origin_[k], exponent_);
        ExactRational step = exact_coordinate(towards_[k], exponent_);
        if (form_ == Form::Segment) step -= o;
        at += n * o;
        slope += n * step;
    }
    return -at / slope;
}

double RayParameter::nearest() const { return error_ == 0 ? value_ : exact().to_double(); }

std::strong_ordering operator<=>(const RayParameter& a, const RayParameter& b) {
    if (a.is_infinite() || b.is_infinite()) return a.is_infinite() <=> b.is_infinite();
    const double d = a.value_ - b.value_;
    const double slack = (a.error_ + b.error_) * detail::bound_slack;
    if (d > slack) return std::strong_ordering::greater;
    if (d < -slack) return std::strong_ordering::less;
    if (slack == 0) return std::strong_ordering::equal;
    if (a.form_ == b.form_ && a.plane_ == b.plane_ && a.origin_ == b.origin_ &&
        a.towards_ == b.towards_)
        return std::strong_ordering::equal;
    return a.exact() <=> b.exact();
}

namespace detail {

namespace {

using Id = IndexPolygons::Id;

const Ray& checked(const Ray& ray) {
    bool moves = false;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(ray.origin[k]) || !std::isfinite(ray.direction[k]))
            throw UsageError("a ray with a coordinate that is not finite");
        moves = moves || ray.direction[k] != 0;
    }
    if (!moves) throw UsageError("a ray without direction");
    return ray;
}

// What a line does at a plane: its equation's value at the origin and along the direction.
struct Course {
    ExactRational at;
    ExactRational slope;
};

Course course(const IndexLine& line, const Plane& plane) {
    Course c{value_at(line.origin().rational(), plane), ExactRational()};
    for (std::size_t k = 0; k < 3; ++k)
        c.slope += line.exact_direction()[k] * ExactRational(plane.normal(static_cast<int>(k)));
    return c;
}

LineContact enclosed(LineContact::Kind kind, const ExactRational& enter,
                     const ExactRational& leave) {
    const double lo = enter.to_double();
    const double hi = leave.to_double();
    const double infinite = std::numeric_limits<double>::infinity();
    return {kind, std::nextafter(lo, -infinite), std::nextafter(hi, infinite)};
}

// The part of a line in a convex polygon. The planes at its two ends; null for the line's own.
struct ExactPart {
    bool exists = false;
    bool in_plane = false;
    ExactRational enter;
    ExactRational leave;
    bool infinite = false;
    const Plane* enter_plane = nullptr;
    const Plane* leave_plane = nullptr;
};

ExactPart exact_part(const IndexLine& line, const Plane& support, std::span<const Plane> edges) {
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    ExactPart part;
    const Course s = course(line, support);
    if (s.slope.sign() != 0) {
        const ExactRational t = -s.at / s.slope;
        if (t.sign() < 0 || (line.is_segment() && t > ExactRational(1))) return part;
        for (const Plane& edge : edges) {
            const Course e = course(line, edge);
            if ((e.at + t * e.slope).sign() > 0) return part;
        }
        part.exists = true;
        part.enter = t;
        part.leave = t;
        part.enter_plane = &support;
        part.leave_plane = &support;
        return part;
    }
    if (s.at.sign() != 0) return part;
    part.in_plane = true;
    part.infinite = !line.is_segment();
    if (line.is_segment()) part.leave = ExactRational(1);
    for (const Plane& edge : edges) {
        const Course e = course(line, edge);
        const int slope = e.slope.sign();
        if (slope == 0) {
            if (e.at.sign() > 0) return part;
            continue;
        }
        ExactRational t = -e.at / e.slope;
        if (slope > 0) {
            if (part.infinite || t < part.leave) {
                part.leave = std::move(t);
                part.leave_plane = &edge;
                part.infinite = false;
            }
        } else if (t > part.enter) {
            part.enter = std::move(t);
            part.enter_plane = &edge;
        }
    }
    part.exists = part.infinite || part.enter <= part.leave;
    return part;
}

LineContact meet_exactly(const IndexPolygons& polygons, Id id, const IndexLine& line) {
    const std::vector<Plane> edges = polygons.edges(id);
    const Plane support = polygons.support(id);
    const ExactPart part = exact_part(line, support, edges);
    if (!part.exists) return {};
    if (!part.in_plane) return enclosed(LineContact::Kind::Point, part.enter, part.enter);
    LineContact c =
        enclosed(LineContact::Kind::Interval, part.enter, part.infinite ? part.enter : part.leave);
    if (part.infinite) c.hi = std::numeric_limits<double>::infinity();
    return c;
}

// QuotientRange of a quotient of two doubles with errors; nothing when the divisor may be 0.
struct QuotientRange {
    double lo = 0;
    double hi = 0;
    bool known = false;
};

QuotientRange quotient(double n, double n_error, double d, double d_error) {
    const double safe = std::fabs(d) - d_error;
    if (!(safe > 0.5 * std::fabs(d))) return {};
    const double t = n / d;
    const double e =
        (n_error + std::fabs(t) * d_error) / safe * bound_slack + std::fabs(t) * 0x1p-51;
    return {t - e, t + e, e < HUGE_VAL};
}

// -1: misses; 0: doubles cannot decide; 1: crosses in `contact`.
int meet_triangle(const Vector3& a, const Vector3& b, const Vector3& c, const IndexLine& line,
                  LineContact& contact) {
    const Vector3& d = line.direction();
    const Vector3& o = line.origin().approximate();
    const Vector3 oa = minus(a, o);
    const Vector3 ob = minus(b, o);
    const Vector3 oc = minus(c, o);
    const double m =
        std::max(std::max(largest_component(oa), largest_component(ob)), largest_component(oc));
    const double dm = largest_component(d);
    const double o_error = line.origin().error();
    const double bound =
        m * m * (difference_determinant_rounding * dm + 6 * line.direction_error()) +
        12 * m * dm * o_error;
    const double e1 = dot(d, cross(oa, ob));
    const double e2 = dot(d, cross(ob, oc));
    const double e3 = dot(d, cross(oc, oa));
    const double lo = std::min(std::min(e1, e2), e3);
    const double hi = std::max(std::max(e1, e2), e3);
    if (lo < -bound && hi > bound) return -1;
    if (!(lo > bound) && !(hi < -bound)) return 0;
    const Vector3 u = minus(b, a);
    const Vector3 v = minus(c, a);
    const Vector3 n = cross(u, v);
    const double l = std::max(largest_component(u), largest_component(v));
    const double l2 = l * l;
    const QuotientRange t = quotient(
        dot(n, oa), l2 * (difference_determinant_rounding * largest_component(oa) + 8 * o_error),
        dot(n, d), l2 * (difference_determinant_rounding * dm + 6 * line.direction_error()));
    if (!t.known) return 0;
    if (t.hi < 0 || t.lo > line.limit()) return -1;
    if (t.lo < 0 || t.hi > line.limit()) return 0;
    contact = {LineContact::Kind::Crossing, t.lo, t.hi};
    return 1;
}

Ball value_of(const Plane& plane, const IndexPoint& p) {
    return value_at_point(plane, p.approximate(), p.error());
}

Ball slope_of(const Plane& plane, const IndexLine& line) {
    return linear_value(plane, 0, line.direction(), line.direction_error());
}

// The same for a fragment, by its corners in doubles; its support is made for what may be hit only.
int meet_fragment(const IndexPolygons& polygons, Id id, const IndexLine& line,
                  LineContact& contact) {
    const LineThrough through(line.origin().approximate(), line.origin().error(), line.direction(),
                              line.direction_error());
    const int side = through.of(polygons.approximate_corners(id));
    if (side < 0) return -1;
    const Plane support = polygons.support(id);
    const Ball at = value_of(support, line.origin());
    const Ball slope = slope_of(support, line);
    const QuotientRange t = quotient(-at.value, at.error, slope.value, slope.error);
    if (!t.known) return 0;
    if (t.hi < 0 || t.lo > line.limit()) return -1;
    if (side == 0 || t.lo < 0 || t.hi > line.limit()) return 0;
    contact = {LineContact::Kind::Crossing, t.lo, t.hi};
    return 1;
}

}  // namespace

IndexLine::IndexLine(const Ray& ray, Lattice lattice)
    : lattice_(lattice),
      ray_(checked(ray)),
      origin_(IndexPoint::from_user(ray.origin, lattice)),
      limit_(std::numeric_limits<double>::infinity()) {
    for (std::size_t k = 0; k < 3; ++k) {
        parallel_[k] = ray.direction[k] == 0;
        direction_[k] = std::ldexp(ray.direction[k], -lattice.exponent);
        if (!std::isfinite(direction_[k]) ||
            std::ldexp(direction_[k], lattice.exponent) != ray.direction[k])
            direction_error_ = HUGE_VAL;
    }
    find_moderate();
}

IndexLine::IndexLine(const Segment& segment, Lattice lattice)
    : lattice_(lattice),
      segment_(segment),
      origin_(IndexPoint::from_user(segment.from, lattice)),
      limit_(1) {
    if (segment.from == segment.to) throw UsageError("a segment whose ends are the same point");
    for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(segment.to[k]))
            throw UsageError("a segment with a coordinate that is not finite");
        parallel_[k] = segment.from[k] == segment.to[k];
        const double d = segment.to[k] - segment.from[k];
        direction_[k] = std::ldexp(d, -lattice.exponent);
        if (!std::isfinite(direction_[k]) || std::ldexp(direction_[k], lattice.exponent) != d) {
            direction_error_ = HUGE_VAL;
        } else {
            direction_error_ =
                std::max(direction_error_, std::fabs(direction_[k]) * unit_roundoff + 0x1p-1000);
        }
    }
    find_moderate();
}

void IndexLine::find_moderate() {
    const double d = largest_component(direction_);
    moderate_ =
        direction_error_ < HUGE_VAL && origin_.error() < HUGE_VAL && d > 0x1p-300 && d < 0x1p300;
}

const IndexPoint::Rational& IndexLine::exact_direction() const {
    if (!exact_direction_) {
        IndexPoint::Rational d;
        for (std::size_t k = 0; k < 3; ++k) {
            if (segment_) {
                d[k] = exact_coordinate(segment_->to[k], lattice_.exponent) -
                       exact_coordinate(segment_->from[k], lattice_.exponent);
            } else {
                d[k] = exact_coordinate(ray_.direction[k], lattice_.exponent);
            }
        }
        exact_direction_ = std::move(d);
    }
    return *exact_direction_;
}

RayParameter IndexLine::meet(const Plane& plane) const {
    return segment_ ? RayParameter(*segment_, lattice_.exponent, plane)
                    : RayParameter(ray_, lattice_.exponent, plane);
}

IndexPoint IndexLine::at(const ExactRational& t) const {
    IndexPoint::Rational p = origin_.rational();
    for (std::size_t k = 0; k < 3; ++k) p[k] += t * exact_direction()[k];
    return IndexPoint(std::move(p));
}

LineContact meet(const IndexPolygons& polygons, Id id, const IndexLine& line) {
    // Products with differences of fractions may underflow.
    if (!polygons.is_whole() && !line.is_moderate()) return meet_exactly(polygons, id, line);
    LineContact contact;
    int known = 0;
    if (polygons.is_triangle(id)) {
        known = meet_triangle(polygons.corner(id, 0).doubles(), polygons.corner(id, 1).doubles(),
                              polygons.corner(id, 2).doubles(), line, contact);
    } else {
        known = polygons.is_unbounded(id) ? 0 : meet_fragment(polygons, id, line, contact);
    }
    if (known != 0) {
        detail::counters_of_thread<PredicateCounters>.filtered += 3;
        return contact;
    }
    return meet_exactly(polygons, id, line);
}

ContactEnds ends_of(const IndexPolygons& polygons, Id id, const IndexLine& line,
                    const LineContact& contact) {
    const Plane support = polygons.support(id);
    if (contact.kind != LineContact::Kind::Interval) {
        const RayParameter t = line.meet(support);
        return {t, t};
    }
    const std::vector<Plane> edges = polygons.edges(id);
    const ExactPart part = exact_part(line, support, edges);
    ContactEnds ends{line.begin(), line.end()};
    if (part.enter_plane != nullptr) ends.enter = line.meet(*part.enter_plane);
    if (part.leave_plane != nullptr) ends.leave = line.meet(*part.leave_plane);
    if (part.infinite) ends.leave = RayParameter::infinite();
    return ends;
}

}  // namespace detail

}  // namespace trisect
