// SPDX-License-Identifier: Apache-2.0
//
// That two trees of planes have a leaf each, both inside and with volume in common, needs one point
// with some room around it; and a ball is the simplest room. Cutting it at a plane leaves the
// largest ball of the part: its diameter goes along the normal from the plane to the far side. Not
// every common part is found that way, since the part of a ball is no ball; but what is found is
// proved, by two inequalities that are checked and not derived: the new ball is within the old one,
// and below the plane.

#include <trisect/bsp/hierarchies/partitions/inner_balls.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::length;
using detail::Vector3;

namespace {}  // namespace

double depth_below(const Vector3& p, const RoughPlane& plane) {
    double at = 0;
    double terms = std::abs(plane.offset);
    for (std::size_t k = 0; k < 3; ++k) {
        const double term = plane.normal[k] * p[k];
        at += term;
        terms += std::abs(term);
    }
    // Errors of the coefficients and of three products and sums.
    const double depth = -(at + plane.offset) - 0x1p-48 * terms;
    return depth / (length(plane.normal) * (depth > 0 ? detail::surely_more : detail::surely_less));
}

std::optional<InnerBall> part_below(const InnerBall& ball, const RoughPlane& plane) {
    const double depth = depth_below(ball.center, plane);
    if (depth > ball.radius) return ball;
    if (!(depth > -ball.radius)) return std::nullopt;
    const double by = 0.5 * (ball.radius - depth);
    const double norm = length(plane.normal);
    InnerBall r;
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        r.center[k] = ball.center[k] - by * (plane.normal[k] / norm);
        far = std::max({far, std::abs(r.center[k]), std::abs(ball.center[k])});
    }
    const Vector3 moved{r.center[0] - ball.center[0], r.center[1] - ball.center[1],
                        r.center[2] - ball.center[2]};
    const double within = ball.radius - length(moved) / detail::surely_less;
    r.radius = std::min(within, depth_below(r.center, plane)) * detail::surely_less;
    // Positions of this size are known to 2^-53 of it; smaller balls are not worth going on with.
    if (!(r.radius > 0x1p-44 * (far + ball.radius))) return std::nullopt;
    return r;
}

// By the columns: |M d|² >= least (|column|² - sum of the other products) |d|².
double least_stretch(const detail::ApproximateMap& map) {
    double least = HUGE_VAL;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double own = 0;
        double others = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double product = 0;
            for (std::size_t k = 0; k < 3; ++k) product += map.m[k][i] * map.m[k][j];
            (i == j ? own : others) += std::abs(product);
        }
        least = std::min(least, own - others);
        most = std::max(most, own + others);
    }
    least -= 0x1p-48 * most;
    return least > 0 ? std::max(0.0, std::sqrt(least) * detail::surely_less - 3 * map.m_error) : 0;
}

std::optional<InnerBall> part_above(const InnerBall& ball, const RoughPlane& plane) {
    return part_below(ball,
                      {{-plane.normal[0], -plane.normal[1], -plane.normal[2]}, -plane.offset});
}

}  // namespace trisect::hierarchies
