// SPDX-License-Identifier: Apache-2.0
//
// Contours of a glyph as shapes.
#pragma once

#include <vector>

#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

/// Inside of a glyph is where its contours do not go around in sum, so that parts of it may
/// overlap. Contours that run as most of the area does are shapes; each of the others is a hole of
/// the smallest shape around its first corner. Contours that cross each other's holes are not
/// foreseen. O(n^2).
[[nodiscard]] std::vector<DrawingShape> glyph_shapes(std::vector<Outline> contours);

}  // namespace trisect::detail
