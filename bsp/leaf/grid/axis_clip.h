// SPDX-License-Identifier: Apache-2.0
//
// Clipping of an axis-perpendicular polygon to a rectangle.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/cells/axis_polygon.h>

namespace trisect::detail {

/// An axis-perpendicular rectangle: for each of the two others, cyclically after it, its lower and
/// its higher side with the plane that ends it there.
template <class Number>
struct AxisRectangle {
    struct Side {
        Number at = 0;  ///< a position
        EdgeName edge;
    };
    std::array<std::array<Side, 2>, 2> sides;
};

/// A new fragment; nothing when no area is left. Edges of the polygon keep their names. Integers
/// decide everything. \pre the polygon has one slanted edge at most.
template <class Number>
[[nodiscard]] std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon<Number>& polygon,
                                                          const AxisRectangle<Number>& rectangle);

}  // namespace trisect::detail
