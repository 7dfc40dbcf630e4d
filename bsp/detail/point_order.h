// SPDX-License-Identifier: Apache-2.0
//
// The order of a workbench's points along an axis.
#pragma once

#include <trisect/bsp/detail/workbench.h>

namespace trisect::detail {

/// -1, 0 or 1 where a comes before b along the axis, with it, or after it: filtered, then exact.
[[nodiscard]] int compare_along(const Workbench& bench, PointId a, PointId b, int axis);

}  // namespace trisect::detail
