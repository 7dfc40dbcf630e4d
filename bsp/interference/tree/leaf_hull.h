// SPDX-License-Identifier: Apache-2.0
//
// LeafHull: an oriented box around the polygons of a leaf.
#pragma once

#include <array>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>

namespace trisect::detail {

/// In units of a power of two about an origin. Polygons are contained as a whole, also what of them
/// is beyond the leaf's cell.
struct LeafHull {
    OrientedBox box;
    std::array<double, 3> origin{};
    double unit = 1;
    /// There is none where polygons are unbounded.
    bool is_known = false;
};

/// Of a leaf that lists something, whether its polygons were arranged or not. Some 30 ns a polygon.
[[nodiscard]] LeafHull hull_of(const CellNode& leaf);

}  // namespace trisect::detail
