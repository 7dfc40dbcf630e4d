// SPDX-License-Identifier: Apache-2.0
//
// Height fields: solids between heights over a grid and a bottom.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect {

/// Heights row by row, each row along x, rows along y.
struct HeightGrid {
    std::span<const double> heights;
    std::uint32_t columns = 0;
    Point2d origin{0, 0};   ///< x and y of the first height
    Point2d spacing{1, 1};  ///< of columns along x, of rows along y
};

/// The solid above z = base and below the heights: four triangles over each rectangle of the grid,
/// to its middle at the mean of its corners; walls of triangles; a bottom of one polygon.
///
/// Heights are taken as they are; x and y are sums of the origin and multiples of the spacing,
/// rounded once or twice, the middle's height four times at most. The mesh does not touch itself:
/// seen from above its triangles lie side by side. O(n).
/// \throw UsageError for fewer than two rows or columns, heights that are no whole number of rows,
/// are not finite or not above the base (with row and column), or a spacing that is not positive or
/// is lost when it is added to the origin; LimitError for more than 2^24 heights.
[[nodiscard]] PolygonMesh make_height_field(const HeightGrid& grid, double base);

}  // namespace trisect
