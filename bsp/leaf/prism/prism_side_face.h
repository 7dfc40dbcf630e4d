// SPDX-License-Identifier: Apache-2.0
//
// PrismSideFace: a rectangle along the axis of a prism.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/kernel/number/flat_corner.h>

namespace trisect::detail {

/// A corner of a facet.
struct PrismCorner {
    std::uint32_t facet = 0;
    int corner = 0;
};

/// The edge along the axis of a facet: numbers of the facet's corners; `edge` is that of the edge.
struct UprightEdge {
    std::uint8_t low = 0;
    std::uint8_t high = 0;
    std::uint8_t edge = 0;
};

/// Two facets with a common diagonal, its halves, or a wall of any facets. Its ends are seen along
/// the axis.
struct PrismSideFace {
    LeafIndex operand = 0;
    LeafIndex wall = -1;  ///< see PrismWalls; -1: two halves
    FlatCorner from{};
    FlatCorner to{};
    Coordinate lo;  ///< along the axis
    Coordinate hi;
    std::array<PolygonRef, 2> facets;  ///< the first one has an edge at `from`, the other at `to`
    std::array<UprightEdge, 2> upright{};  ///< these edges; of walls they may be parts of the sides
    std::array<bool, 2> above_is_left{};   ///< above a facet's support, seen from `from` to `to`
    bool inside_is_left = false;           ///< of the operand
    std::size_t first_layer = 0;           ///< see PrismFacets
    std::size_t end_layer = 0;

    [[nodiscard]] bool is_in(std::size_t layer) const {
        return layer >= first_layer && layer < end_layer;
    }
};

}  // namespace trisect::detail
