// SPDX-License-Identifier: Apache-2.0
//
// Values of a plane's equation at approximate points.
// Each comes with a proved bound of its error.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/ball.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/plane.h>

namespace trisect::detail {

/// first + n · c, where the exact vector is within `error` of c in each coordinate; `first` carries
/// at most one rounding. With the plane's offset as `first` the value at a point, with 0 that of a
/// direction.
[[nodiscard]] inline Ball linear_value(const Plane& plane, double first,
                                       const std::array<double, 3>& c, double error) {
    double value = first;
    double terms = std::fabs(first);
    double normals = 0;
    for (int k = 0; k < 3; ++k) {
        const double n = plane.approx_normal(k);
        const double t = n * c[static_cast<std::size_t>(k)];
        value += t;
        terms += std::fabs(t);
        normals += std::fabs(n);
    }
    return {value, plane_value_rounding * terms + error_slack * (error * normals)};
}

[[nodiscard]] inline Ball value_at_point(const Plane& plane, const std::array<double, 3>& c,
                                         double error) {
    return linear_value(plane, plane.approx_offset(), c, error);
}

}  // namespace trisect::detail
