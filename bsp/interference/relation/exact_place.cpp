// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/exact_place.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using RationalVector = std::array<ExactRational, 3>;

ExactRational rational(const BoundedInt& n, const BoundedInt& d) {
    const auto limbs = [](const BoundedInt& v) {
        std::vector<std::uint64_t> out;
        for (int i = 0; i < v.size(); ++i) out.push_back(v.limb(i));
        return out;
    };
    return ExactRational::from_limbs((n.sign() < 0) != (d.sign() < 0), limbs(n), limbs(d));
}

// from + s (to - from)
ExactPlace along(const ExactPlace& from, const ExactPlace& to, const ExactRational& s) {
    ExactPlace r;
    for (std::size_t i = 0; i < 3; ++i) r.c[i] = from.c[i] + s * (to.c[i] - from.c[i]);
    return r;
}

ExactRational value_at(const Plane& plane, const ExactPlace& p) {
    ExactRational v(plane.offset());
    for (int i = 0; i < 3; ++i)
        v += ExactRational(plane.normal(i)) * p.c[static_cast<std::size_t>(i)];
    return v;
}

// Where the line from p to q meets a plane.
ExactPlace on_plane(const ExactPlace& p, const ExactPlace& q, const Plane& plane) {
    const ExactRational u = value_at(plane, p);
    const ExactRational v = value_at(plane, q);
    return along(p, q, u / (u - v));
}

}  // namespace

std::strong_ordering operator<=>(const ExactPlace& a, const ExactPlace& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (const auto order = a.c[i] <=> b.c[i]; order != 0) return order;
    return std::strong_ordering::equal;
}

ExactPlace exact_place(const Point& p) {
    const IntPoint x = exact_point(p);
    return {{rational(x.x[0], x.w), rational(x.x[1], x.w), rational(x.x[2], x.w)}};
}

ExactPlace moved(const ExactPlace& p, const RelativePose& pose) {
    const BoundedInt one(1);
    ExactPlace r;
    for (std::size_t i = 0; i < 3; ++i) {
        ExactRational sum = rational(pose.translation()[i], one);
        for (std::size_t j = 0; j < 3; ++j) sum += rational(pose.row(i)[j], one) * p.c[j];
        r.c[i] = sum / rational(pose.denominator(), one);
    }
    return r;
}

std::array<ExactRational, 3> in_world(const ExactPlace& p, Lattice lattice, const Pose& pose) {
    std::array<ExactRational, 3> r;
    for (std::size_t i = 0; i < 3; ++i) {
        r[i] = ExactRational(pose.translation(i));
        for (std::size_t j = 0; j < 3; ++j)
            r[i] += ExactRational(pose.matrix(i, j)) * p.c[j].scaled(lattice.exponent);
        r[i] /= ExactRational(pose.denominator());
    }
    return r;
}

ExactPlace place_of(const PosedModels& models, const MeetingPair& pair, const MeetingPoint& point) {
    return place_of(posed_triangle(models.a, pair.a), posed_triangle(models.b, pair.b),
                    models.poses, point);
}

ExactPlace place_of(const PosedTriangle& a, const PosedTriangle& b, const PosedPair& poses,
                    const MeetingPoint& point) {
    const auto corner_a = [&](std::size_t i) { return exact_place(*a.corner[i % 3]); };
    const auto corner_b = [&](std::size_t i) { return exact_place(*b.corner[i % 3]); };
    const auto corner_b_moved = [&](std::size_t i) { return moved(corner_b(i), poses.to_a); };
    if (point.a.is_corner()) return corner_a(point.a.index());
    if (point.b.is_corner()) return corner_b_moved(point.b.index());
    if (point.a.is_side() && point.b.is_side()) {
        const ExactPlace p = corner_a(point.a.index());
        const ExactPlace q = corner_a(point.a.index() + 1);
        const ExactPlace r = corner_b_moved(point.b.index());
        const RationalVector u = minus(q.c, p.c);
        const RationalVector v = minus(corner_b_moved(point.b.index() + 1).c, r.c);
        const RationalVector uv = cross(u, v);
        return along(p, q, dot(cross(minus(r.c, p.c), v), uv) / dot(uv, uv));
    }
    if (point.a.is_side()) {  // through B's face: found in B's lattice, where its plane is
        const ExactPlace p = moved(corner_a(point.a.index()), poses.to_b);
        const ExactPlace q = moved(corner_a(point.a.index() + 1), poses.to_b);
        return moved(on_plane(p, q, *b.plane), poses.to_a);
    }
    TRISECT_EXPECTS(point.b.is_side(), "the place of a point within two triangles");
    return on_plane(corner_b_moved(point.b.index()), corner_b_moved(point.b.index() + 1), *a.plane);
}

std::optional<Feature> feature_at(const InterferenceModelData& model, std::uint32_t triangle,
                                  const ExactPlace& point) {
    return feature_at(posed_triangle(model, triangle), point);
}

std::optional<Feature> feature_at(const PosedTriangle& t, const ExactPlace& point) {
    // A quick look at the box: rounding is monotone.
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = point.c[k].to_double();
        const auto c = [&](std::size_t i) { return t.corner[i]->nearest()[k]; };
        if (x < std::min({c(0), c(1), c(2)}) || x > std::max({c(0), c(1), c(2)}))
            return std::nullopt;
    }
    if (value_at(*t.plane, point).sign() != 0) return std::nullopt;
    const int axis = t.plane->dominant_axis();
    const auto i = static_cast<std::size_t>((axis + 1) % 3);
    const auto j = static_cast<std::size_t>((axis + 2) % 3);
    const int up = t.plane->normal(axis) > 0 ? 1 : -1;
    std::array<int, 3> signs{};
    for (std::size_t k = 0; k < 3; ++k) {
        const ExactPlace p = exact_place(*t.corner[k]);
        const ExactPlace q = exact_place(*t.corner[(k + 1) % 3]);
        signs[k] = up * ((q.c[i] - p.c[i]) * (point.c[j] - p.c[j]) -
                         (q.c[j] - p.c[j]) * (point.c[i] - p.c[i]))
                            .sign();
        if (signs[k] < 0) return std::nullopt;
    }
    return feature_from_signs(signs);
}

}  // namespace trisect::detail
