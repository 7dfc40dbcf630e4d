// SPDX-License-Identifier: Apache-2.0
//
// Clipping of an axis-perpendicular polygon to a rectangle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/axis_polygon.h>

namespace trisect::detail {

/// An axis-perpendicular rectangle: for each of the two others, cyclically after it, its lower and
/// its higher side with the plane that ends it there.
struct AxisRectangle {
    struct Side {
        std::int64_t at = 0;  ///< in 1/192 lattice units
        EdgeName edge;
    };
    std::array<std::array<Side, 2>, 2> sides;
};

/// A new fragment; nothing when no area is left. Edges of the polygon keep their names. Integers
/// decide everything. \pre the polygon has one slanted edge at most.
[[nodiscard]] std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon& polygon,
                                                          const AxisRectangle& rectangle);

}  // namespace trisect::detail
