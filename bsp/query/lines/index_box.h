// SPDX-License-Identifier: Apache-2.0
//
// Box queries of an index.
#pragma once

#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

/// The polygons that meet the closed box from `lo` to `hi`. Sorted.
[[nodiscard]] std::vector<PolygonId> polygons_in_box(const IndexBase& index, const IndexPoint& lo,
                                                     const IndexPoint& hi);

/// Whether the segment between two points meets the box.
[[nodiscard]] bool meets_box(const Point& a, const Point& b, const IndexPoint& lo,
                             const IndexPoint& hi);
[[nodiscard]] bool is_in_box(const Point& p, const IndexPoint& lo, const IndexPoint& hi);

}  // namespace trisect::detail
