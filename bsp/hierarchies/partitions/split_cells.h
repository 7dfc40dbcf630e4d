// SPDX-License-Identifier: Apache-2.0
//
// SplitCells: a boundary divided into cells by axis-perpendicular splitting planes.
// A cell has few polygons. Below it is a tree of face planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/plane.h>

namespace trisect::hierarchies {

/// A tree of splitting planes over a boundary. A splitting plane is at an odd multiple of half a
/// lattice unit or, where coordinates have fractions, at a third of a fraction, so no vertex and no
/// polygon lies on it. There is area of the boundary on both
/// sides of every splitting plane; so every cell holds a part of it, and face planes alone
/// distinguish inside from outside within a cell.
///
/// A tree of face planes is as deep as the solid makes it: a convex one's is a list. Under
/// splitting planes it is the depth of a balanced tree and the few planes of a cell.
struct SplitCells {
    /// A splitting plane by its number, or a cell.
    using Ref = std::int32_t;
    [[nodiscard]] static constexpr Ref cell_ref(std::size_t cell) {
        return ~static_cast<Ref>(cell);
    }

    struct SplittingPlane {
        Plane plane;
        Ref below = 0;
        Ref above = 0;
        trisect::detail::BodyBox box_below;  ///< around all polygons there
        trisect::detail::BodyBox box_above;
    };
    struct Cell {
        std::vector<ConvexPolygon> polygons;   ///< of triangles, their parts within the cell
        std::vector<std::uint32_t> triangles;  ///< of which each polygon is a part
        std::vector<Plane> splitters;          ///< the cell is below all of them
        trisect::detail::BodyBox box;          ///< around the polygons, where vertices are exact
    };

    std::vector<SplittingPlane> splitters;  ///< the first one is the root
    std::vector<Cell> cells;

    [[nodiscard]] Ref root() const { return splitters.empty() ? cell_ref(0) : 0; }

    /// Cells of more than `most` polygons are divided, unless every splitting plane leaves nearly
    /// all of them on one side. O(n log n) exact cuts and signs. \pre all vertices of the model are
    /// lattice points, and it is not empty.
    [[nodiscard]] static SplitCells over(const detail::InterferenceModelData& model,
                                         std::size_t most);
};

}  // namespace trisect::hierarchies
