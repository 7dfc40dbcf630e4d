// SPDX-License-Identifier: Apache-2.0
//
// Filtered orientation of four exact points.
#pragma once

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/filters.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// The sign of det(a - d, b - d, c - d), 0 when doubles cannot decide. Points are exact.
[[nodiscard]] inline int filtered_orientation(const Vector3& a, const Vector3& b, const Vector3& c,
                                              const Vector3& d) {
    static_assert(Roundoff<double>::times_8 == orientation_rounding);
    return filter_orientation(a, b, c, d).sign();
}

}  // namespace trisect::detail
