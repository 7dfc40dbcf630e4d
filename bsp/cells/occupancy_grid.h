// SPDX-License-Identifier: Apache-2.0
//
// OccupancyGrid: the bits of a set in a cell of axis-perpendicular facets.
// It bounds the set before any facet is cut.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/axis_grid.h>
#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// A set as bits of the units of a grid, and the facets that bound it. Who writes the result as a
/// mesh needs no more where all facets of a plane have changed (axis_faces.h).
struct OccupancyGrid {
    /// What of a facet bounds the set.
    struct Part {
        bool is_cut = false;  ///< some of the facet does not, or faces the other way
        std::uint8_t corners =
            0;  ///< those of the facet's corners that have such a part, a bit each
    };
    /// One layer of units: a word for each row (UnitFrame).
    using Layer = UnitRows;

    /// Positions of the planes of each axis, bounding planes of the cell first and last; as those
    /// of coordinates with fractions.
    std::array<std::vector<Int128>, 3> planes;
    /// Bits of all units: layer by layer across z, row by row along y, a bit for each along x.
    std::vector<std::uint64_t> units;
    /// Whole facets, each once for each facing; `touched` are those that are cut.
    PolygonList facets;
    std::vector<Part> parts;  ///< of `facets`

    /// The layers between the planes of an axis.
    [[nodiscard]] std::vector<Layer> layers(std::size_t axis) const;
    [[nodiscard]] std::size_t bytes() const;
};

/// Makes bit i of row j bit j of row i. All rows and bits from `size` on are zero.
/// \pre 0 < size <= axis_units_limit
void transpose(UnitRows& rows, std::size_t size);

}  // namespace trisect::detail
