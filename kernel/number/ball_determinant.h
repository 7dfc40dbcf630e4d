// SPDX-License-Identifier: Apache-2.0
//
// Determinant of three rounded vectors, with a bound of its error.
#pragma once

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/ball.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// det(a, b, c), whose components carry one rounding each.
[[nodiscard]] inline Ball determinant(const Vector3& a, const Vector3& b, const Vector3& c) {
    double sum = 0;
    double magnitude = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double p = a[(i + 1) % 3] * b[(i + 2) % 3];
        const double q = a[(i + 2) % 3] * b[(i + 1) % 3];
        sum += (p - q) * c[i];
        magnitude += (std::fabs(p) + std::fabs(q)) * std::fabs(c[i]);
    }
    return {sum, determinant_rounding * magnitude};
}

}  // namespace trisect::detail
