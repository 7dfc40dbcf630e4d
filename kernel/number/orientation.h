// SPDX-License-Identifier: Apache-2.0
//
// Filtered orientation of four exact points.
#pragma once

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// The sign of det(a - d, b - d, c - d), 0 when doubles cannot decide. Points are exact.
[[nodiscard]] inline int filtered_orientation(const Vector3& a, const Vector3& b, const Vector3& c,
                                              const Vector3& d) {
    const Vector3 p = minus(a, d);
    const Vector3 q = minus(b, d);
    const Vector3 r = minus(c, d);
    double sum = 0;
    double permanent = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const double s = q[i] * r[j];
        const double t = q[j] * r[i];
        sum += p[k] * (s - t);
        permanent += std::fabs(p[k]) * (std::fabs(s) + std::fabs(t));
    }
    return certain_sign(sum, orientation_rounding * permanent);
}

}  // namespace trisect::detail
