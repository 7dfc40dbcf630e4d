// SPDX-License-Identifier: Apache-2.0
//
// Order of a workbench's points along an axis.
#pragma once

#include <cmath>
#include <cstddef>

#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// Where doubles do not decide: by planes perpendicular to the axis, then by fractions.
[[nodiscard]] int compare_closely_along(const Workbench& bench, PointId a, PointId b, int axis);

/// -1, 0 or 1 where a comes before b along the axis, with it, or after it: filtered, then exact.
[[nodiscard]] inline int compare_along(const Workbench& bench, PointId a, PointId b, int axis) {
    const Approximation& pa = bench.approximation(a);
    const Approximation& pb = bench.approximation(b);
    const double gap = pa.c[static_cast<std::size_t>(axis)] - pb.c[static_cast<std::size_t>(axis)];
    if (std::fabs(gap) > error_slack * (pa.error + pb.error)) return gap < 0 ? -1 : 1;
    return compare_closely_along(bench, a, b, axis);
}

}  // namespace trisect::detail
