// SPDX-License-Identifier: Apache-2.0
//
// Two far points give the first direction, the point farthest from their line the second. Nothing
// depends on the directions being good, or orthonormal: half lengths are measured as coefficients
// with respect to them, and what is left over beyond is paid for by the slack.

#include <trisect/bsp/msp/msp_oriented_box.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail::msp {

namespace {

Vector3 without(const Vector3& v, const Vector3& axis) {
    const double along = dot(v, axis);
    return {v[0] - along * axis[0], v[1] - along * axis[1], v[2] - along * axis[2]};
}
Vector3 unit(const Vector3& v, const Vector3& otherwise) {
    const double length = std::sqrt(dot(v, v));
    if (!(length > 0)) return otherwise;
    return {v[0] / length, v[1] / length, v[2] / length};
}

template <class Measure>
const Approximation& farthest(std::span<const Approximation> points, Measure&& measure) {
    return *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return measure(a.c) < measure(b.c);
    });
}

}  // namespace

OrientedBox::OrientedBox(std::span<const Approximation> points) {
    const Vector3 start = points.front().c;
    const auto distance_from = [](const Vector3& o) {
        return [o](const Vector3& p) { return dot(minus(p, o), minus(p, o)); };
    };
    const Vector3 one_end = farthest(points, distance_from(start)).c;
    const Vector3 other_end = farthest(points, distance_from(one_end)).c;
    std::array<Vector3, 3> direction{};
    direction[0] = unit(minus(other_end, one_end), {1, 0, 0});
    const auto off_line = [&](const Vector3& p) {
        return without(minus(p, one_end), direction[0]);
    };
    const Vector3 aside = off_line(
        farthest(points, [&](const Vector3& p) { return dot(off_line(p), off_line(p)); }).c);
    direction[1] = unit(aside, {0, 0, 0});
    direction[2] = {direction[0][1] * direction[1][2] - direction[0][2] * direction[1][1],
                    direction[0][2] * direction[1][0] - direction[0][0] * direction[1][2],
                    direction[0][0] * direction[1][1] - direction[0][1] * direction[1][0]};

    std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Approximation& p : points) {
        const Vector3 v = minus(p.c, one_end);
        Vector3 rest = v;
        for (std::size_t i = 0; i < 3; ++i) {
            const double along = dot(rest, direction[i]);
            lo[i] = std::min(lo[i], along);
            hi[i] = std::max(hi[i], along);
            for (std::size_t k = 0; k < 3; ++k) rest[k] -= along * direction[i][k];
        }
        // What the three steps left of the point, and what they lost to rounding.
        double magnitude = 0;
        for (std::size_t k = 0; k < 3; ++k)
            magnitude += std::fabs(p.c[k]) + std::fabs(one_end[k]) + std::fabs(v[k]);
        const double left = std::fabs(rest[0]) + std::fabs(rest[1]) + std::fabs(rest[2]);
        slack_ = std::max(slack_, 2 * p.error + left + 0x1p-46 * magnitude);
    }
    centre_ = one_end;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            centre_[k] += 0.5 * (lo[i] + hi[i]) * direction[i][k];
            axis_[i][k] = 0.5 * (hi[i] - lo[i]) * direction[i][k];
        }
    }
}

Side OrientedBox::side(const Plane& plane) const {
    const Vector3 n{plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2)};
    double s = plane.approx_offset();
    double terms = std::fabs(s);
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        s += n[k] * centre_[k];
        terms += std::fabs(n[k] * centre_[k]);
        reach += std::fabs(n[k]) * slack_;
    }
    for (const Vector3& a : axis_) {
        reach += std::fabs(dot(n, a));
        // The dot product's own rounding.
        terms += std::fabs(n[0] * a[0]) + std::fabs(n[1] * a[1]) + std::fabs(n[2] * a[2]);
    }
    const double bound = error_slack * reach + 0x1p-47 * terms;
    return s > bound ? Side::Above : (s < -bound ? Side::Below : Side::On);
}

}  // namespace trisect::detail::msp
