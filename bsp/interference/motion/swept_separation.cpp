// SPDX-License-Identifier: Apache-2.0
//
// A direction that keeps two triangles apart in the middle of a short interval mostly does so all
// the time. Along it the lead of a corner of B over A, times the weight of the motion, is a
// polynomial; where its Bernstein coefficients are positive it is. So the error of the test falls
// with the square of the interval, while that of a box grown by the sweep falls with its length.
// Directions are proposals: that of closest points in the middle, and both normals.

#include <trisect/bsp/interference/motion/swept_separation.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector3 weighted(const TriangleCorners& p, const std::array<double, 3>& w) {
    Vector3 r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) r[k] += w[i] * p[i][k];
    return r;
}
Vector3 normal(const TriangleCorners& p) { return cross(p[1] - p[0], p[2] - p[0]); }

// Scaled to about 1, or 0 where that fails.
Vector3 unit_or_zero(const Vector3& v) {
    const double length = std::sqrt(dot(v, v));
    if (!(length > 0x1p-500) || !std::isfinite(length)) return {};
    return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace

bool SweptSeparation::are_apart(std::uint32_t triangle_a, std::uint32_t triangle_b) {
    if (moved_ != triangle_b) move(triangle_b);
    const TriangleCorners p = a_.corners_of(triangle_a);
    std::array<BallVector, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) corners[i][k] = Ball(p[i][k], a_.position_error);
    const TriangleCorners& q = in_the_middle_;
    const ClosestPoints closest = closest_points(p, q);
    const Vector3 way = weighted(q, closest.on_q) - weighted(p, closest.on_p);
    if (is_separated_along(unit_or_zero(way), corners)) return true;
    const std::array<double, 3> third{1. / 3, 1. / 3, 1. / 3};
    const Vector3 centres = weighted(q, third) - weighted(p, third);
    for (Vector3 n : {normal(p), normal(q)}) {
        if (dot(n, centres) < 0) n = Vector3{} - n;
        if (is_separated_along(unit_or_zero(n), corners)) return true;
    }
    return false;
}

void SweptSeparation::move(std::uint32_t triangle_b) {
    moved_ = triangle_b;
    const TriangleCorners at_rest = b_.corners_of(triangle_b);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3& x = at_rest[i];
        in_the_middle_[i] = middle_.map(x);
        const double e = b_.position_error;
        const BallVector ball{Ball(x[0], e), Ball(x[1], e), Ball(x[2], e)};
        for (std::size_t k = 0; k <= over_.degree; ++k)
            paths_[i][k] = over_.maps[k].matrix * ball + over_.maps[k].shift;
    }
}

bool SweptSeparation::is_separated_along(const Vector3& d,
                                         const std::array<BallVector, 3>& corners) const {
    const BallVector direction{Ball(d[0]), Ball(d[1]), Ball(d[2])};
    double highest = -HUGE_VAL;
    for (const BallVector& corner : corners)
        highest = std::max(highest, detail::dot(direction, corner).upper());
    const double length = std::sqrt(dot(d, d)) * slightly_more;
    const Ball limit(highest + margin_ * length * slightly_more +
                     0x1p-50 * (std::abs(highest) + margin_));
    for (std::size_t k = 0; k <= over_.degree; ++k) {
        const Ball height = limit * over_.maps[k].weight;
        for (const Path& path : paths_)
            if ((detail::dot(direction, path[k]) - height).sign() <= 0) return false;
        if (over_.maps[k].weight.sign() <= 0) return false;
    }
    return length > 0;
}

}  // namespace trisect::detail
