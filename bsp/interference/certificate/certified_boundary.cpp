// SPDX-License-Identifier: Apache-2.0
//
// All points are integers over a weight and all planes integers, so that every question is the sign
// of a sum of products. Nothing is sorted into boxes and nothing rounded: this is slow and plain on
// purpose, but not slower than it must be.

#include <trisect/bsp/interference/certificate/certified_boundary.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace trisect::detail::certified {

namespace {

IntegerPoint placed(const Point& p, int exponent, const Pose& pose) {
    const HomogeneousPoint h = p.homogeneous();
    const auto up = static_cast<unsigned long>(std::max(exponent, 0));
    const auto down = static_cast<unsigned long>(std::max(-exponent, 0));
    const mpz_class w = to_gmp(h.w) << down;
    IntegerVector from;
    for (std::size_t i = 0; i < 3; ++i) from[i] = to_gmp(h.xyz[i]) << up;
    IntegerVector to;
    for (std::size_t i = 0; i < 3; ++i)
        to[i] =
            form({to_gmp(pose.matrix(i, 0)), to_gmp(pose.matrix(i, 1)), to_gmp(pose.matrix(i, 2))},
                 to_gmp(pose.translation(i)), from, w);
    return {std::move(to), to_gmp(pose.denominator()) * w};
}

// Of (u, v, p) seen along an axis, in a right-handed order of the other two: 1 when it turns left.
int turn(const IntegerPoint& u, const IntegerPoint& v, const IntegerPoint& p, std::size_t axis) {
    const std::size_t x = (axis + 1) % 3;
    const std::size_t y = (axis + 2) % 3;
    return sgn(mpz_class(u.x[x] * (v.x[y] * p.w - v.w * p.x[y]) -
                         u.x[y] * (v.x[x] * p.w - v.w * p.x[x]) +
                         u.w * (v.x[x] * p.x[y] - v.x[y] * p.x[x])));
}
int compare(const IntegerPoint& u, const IntegerPoint& v, std::size_t axis) {
    return cmp(u.x[axis] * v.w, v.x[axis] * u.w);
}

std::size_t steep_axis(const IntegerPlane& plane) {
    std::size_t k = 0;
    while (k < 2 && sgn(plane.normal[k]) == 0) ++k;
    return k;
}

// Of a point and a triangle.
ExactRational squared_distance(const ExactPoint& p, const std::array<ExactPoint, 3>& t) {
    const ExactPoint n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const ExactRational nn = dot(n, n);
    bool above = nn.sign() != 0;
    for (std::size_t i = 0; above && i < 3; ++i)
        above = dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(p, t[i])).sign() >= 0;
    if (above) {
        const ExactRational h = dot(n, minus(p, t[0]));
        return h * h / nn;
    }
    std::optional<ExactRational> least;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint d = minus(t[(i + 1) % 3], t[i]);
        const ExactPoint w = minus(p, t[i]);
        const ExactRational dd = dot(d, d);
        ExactRational part = dd.sign() == 0 ? ExactRational() : dot(w, d) / dd;
        part = std::clamp(part, ExactRational(), ExactRational(1));
        const ExactPoint way{w[0] - part * d[0], w[1] - part * d[1], w[2] - part * d[2]};
        const ExactRational squared = dot(way, way);
        if (!least || squared < *least) least = squared;
    }
    return *least;
}

// The six planes of a cube around a point: above one of them is out of the cube.
std::array<IntegerPlane, 6> planes_around(const ExactPoint& p, const ExactRational& radius) {
    std::array<IntegerPlane, 6> r;
    for (std::size_t k = 0; k < 6; ++k) {
        SeparatingPlane plane;
        const ExactRational sign(k < 3 ? 1 : -1);
        plane.normal[k % 3] = sign;
        plane.offset = -(sign * p[k % 3] + radius);
        r[k] = IntegerPlane(plane);
    }
    return r;
}

}  // namespace

Boundary::Boundary(const Brep& brep, const Pose& pose) : brep_(&brep) {
    for (const Point& p : brep.points())
        points_.push_back(placed(p, brep.lattice().exponent, pose));
    std::vector<std::uint32_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [this](std::uint32_t i, std::uint32_t j) {
        if (points_[i] == points_[j]) return i < j;
        return points_[i] < points_[j];
    });
    place_.resize(points_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place_[order[i]] =
            i > 0 && points_[order[i]] == points_[order[i - 1]] ? place_[order[i - 1]] : order[i];
    for (const FaceId f : brep.faces()) planes_.push_back(plane_of(f));
}

// The normal is twice the vector area of the outer loop, counter-clockwise about it, mirrored or
// not; its corners are put on a common weight first.
IntegerPlane Boundary::plane_of(FaceId f) const {
    mpz_class common = 1;
    for (const HalfedgeId h : brep_->halfedges(brep_->outer_loop(f)))
        common = lcm(common, points_[brep_->origin(h).index].w);
    std::vector<IntegerVector> corners;
    for (const HalfedgeId h : brep_->halfedges(brep_->outer_loop(f))) {
        const IntegerPoint& p = points_[brep_->origin(h).index];
        const mpz_class factor = common / p.w;
        corners.push_back({p.x[0] * factor, p.x[1] * factor, p.x[2] * factor});
    }
    IntegerPlane plane;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const IntegerVector& u = corners[i];
        const IntegerVector& v = corners[(i + 1) % corners.size()];
        for (std::size_t k = 0; k < 3; ++k)
            plane.normal[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    plane.offset = -form(plane.normal, 0, corners.front(), 0);
    for (mpz_class& c : plane.normal) c *= common;
    return plane;
}

Where Boundary::locate(const ExactPoint& point) const {
    const IntegerPoint p(point);
    for (const FaceId f : brep_->faces())
        if (planes_[f.index].side_of(p) == 0 && in_face(f, p) != Where::Outside)
            return Where::Boundary;
    // Directions of no special meaning; one that meets no edge is found soon.
    std::int64_t seed = 1;
    const auto number = [&seed] {
        seed = (seed * 48271) % 2147483647;
        return mpz_class(static_cast<long>(seed % 2001 - 1000));
    };
    for (int attempt = 0; attempt < 50; ++attempt) {
        const IntegerVector d{number(), number(), number()};
        if (const Where w = along_ray(p, d); w != Where::Unknown) return w;
    }
    return Where::Unknown;
}

bool Boundary::is_on_face(FaceId f, const ExactPoint& point) const {
    if (f.index >= brep_->faces().size()) return false;
    const IntegerPoint p(point);
    return planes_[f.index].side_of(p) == 0 && in_face(f, p) != Where::Outside;
}

// Even-odd in the face's plane, of a point in it.
Where Boundary::in_face(FaceId f, const IntegerPoint& p) const {
    const std::size_t axis = steep_axis(planes_[f.index]);
    const std::size_t x = (axis + 1) % 3;
    const std::size_t y = (axis + 2) % 3;
    bool inside = false;
    for (const HalfedgeId h : brep_->halfedges(f)) {
        const IntegerPoint& u = points_[brep_->origin(h).index];
        const IntegerPoint& v = points_[brep_->target(h).index];
        const int uy = compare(u, p, y);
        const int vy = compare(v, p, y);
        if (uy * vy > 0) continue;
        const int s = turn(u, v, p, axis);
        if (s == 0 && compare(u, p, x) * compare(v, p, x) <= 0) return Where::Boundary;
        if ((uy > 0) == (vy > 0)) continue;
        if ((s > 0) == (vy > 0)) inside = !inside;
    }
    return inside ? Where::Inside : Where::Outside;
}

// The ray p / w + t d meets a plane at t = -value / (w speed).
Where Boundary::along_ray(const IntegerPoint& p, const IntegerVector& d) const {
    bool inside = false;
    for (const FaceId f : brep_->faces()) {
        const IntegerPlane& plane = planes_[f.index];
        const mpz_class speed = form(plane.normal, 0, d, 0);
        if (sgn(speed) == 0) return Where::Unknown;
        const mpz_class value = plane.value_at(p);
        if (sgn(value) * sgn(speed) >= 0) continue;
        IntegerPoint hit;
        for (std::size_t i = 0; i < 3; ++i) hit.x[i] = abs(speed) * p.x[i] + abs(value) * d[i];
        hit.w = abs(speed) * p.w;
        const Where w = in_face(f, hit);
        if (w == Where::Boundary) return Where::Unknown;
        if (w == Where::Inside) inside = !inside;
    }
    return inside ? Where::Inside : Where::Outside;
}

bool Boundary::is_deep_inside(const ExactPoint& p, const ExactRational& radius,
                              const std::vector<CertifiedTriangle>& triangles) const {
    const std::array<IntegerPlane, 6> around = planes_around(p, radius);
    for (const CertifiedTriangle& t : triangles) {
        for (const VertexId v : t.vertex)
            if (v.index >= points_.size()) return false;
        const auto is_beyond = [&](const IntegerPlane& plane) {
            return std::ranges::all_of(
                t.vertex, [&](VertexId v) { return plane.side_of(points_[v.index]) > 0; });
        };
        if (std::ranges::any_of(around, is_beyond)) continue;
        if (squared_distance(p, {at(t.vertex[0]), at(t.vertex[1]), at(t.vertex[2])}) <=
            radius * radius)
            return false;
    }
    return locate(p) == Where::Inside;
}

bool Boundary::is_filled_by(const std::vector<CertifiedTriangle>& triangles) const {
    // A face, both ends of a side, the smaller place first, and the direction.
    struct Side {
        std::array<std::uint32_t, 3> key;
        int sign;
    };
    std::vector<Side> sides;
    const auto add = [&](FaceId face, VertexId p, VertexId q, int sign) {
        const std::uint32_t u = place_[p.index];
        const std::uint32_t v = place_[q.index];
        if (u < v)
            sides.push_back({{face.index, u, v}, sign});
        else
            sides.push_back({{face.index, v, u}, -sign});
    };
    for (const CertifiedTriangle& t : triangles) {
        if (t.face.index >= brep_->faces().size()) return false;
        const IntegerPlane& plane = planes_[t.face.index];
        for (const VertexId v : t.vertex)
            if (v.index >= points_.size() || plane.side_of(points_[v.index]) != 0) return false;
        const std::size_t axis = steep_axis(plane);
        if (turn(points_[t.vertex[0].index], points_[t.vertex[1].index], points_[t.vertex[2].index],
                 axis) != sgn(plane.normal[axis]))
            return false;
        for (std::size_t i = 0; i < 3; ++i) add(t.face, t.vertex[i], t.vertex[(i + 1) % 3], 1);
    }
    for (const FaceId f : brep_->faces())
        for (const HalfedgeId h : brep_->halfedges(f))
            add(f, brep_->origin(h), brep_->target(h), -1);
    std::ranges::sort(sides, {}, &Side::key);
    for (std::size_t i = 0; i < sides.size();) {
        int sum = 0;
        const auto key = sides[i].key;
        for (; i < sides.size() && sides[i].key == key; ++i) sum += sides[i].sign;
        if (sum != 0) return false;
    }
    return true;
}

std::vector<std::set<std::pair<IntegerPoint, IntegerPoint>>> Boundary::outlines() const {
    std::vector<std::set<std::pair<IntegerPoint, IntegerPoint>>> all;
    for (const FaceId f : brep_->faces()) {
        auto& outline = all.emplace_back();
        for (const HalfedgeId h : brep_->halfedges(f))
            outline.insert(
                std::minmax(points_[brep_->origin(h).index], points_[brep_->target(h).index]));
    }
    std::ranges::sort(all);
    return all;
}

}  // namespace trisect::detail::certified
