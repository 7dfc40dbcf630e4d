// SPDX-License-Identifier: Apache-2.0
//
// Facets of prisms: caps and side faces.
// A cap is perpendicular to the axis of the prism, a side face parallel to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A rectangle along the axis: two facets with a common diagonal. Its ends are seen along the axis.
struct PrismSideFace {
    LeafIndex operand = 0;
    FlatCorner from{};
    FlatCorner to{};
    Coordinate lo;  ///< along the axis
    Coordinate hi;
    std::array<PolygonRef, 2> facets;  ///< the first one has an edge at `from`, the other at `to`
    std::array<bool, 2> above_is_left{};  ///< above a facet's support, seen from `from` to `to`
    bool inside_is_left = false;          ///< of the operand
    std::size_t first_layer = 0;          ///< see PrismFacets
    std::size_t end_layer = 0;

    [[nodiscard]] bool is_in(std::size_t layer) const {
        return layer >= first_layer && layer < end_layer;
    }
};

/// Leaves of prisms may be so many times as large as others.
inline constexpr std::uint32_t prism_leaf_factor = 40;

/// A facet perpendicular to the axis.
struct PrismCap {
    LeafIndex operand = 0;
    PolygonRef ref;
    std::size_t position = 0;  ///< see PrismFacets
};

/// The facets of a leaf whose operands are all unions of prisms along one axis. The caps' positions
/// divide the space into layers, in which nothing depends on the axis: layer i ends at position i.
class PrismFacets {
public:
    /// False when some polygon is neither perpendicular to the axis nor one of the two halves of a
    /// rectangle along it, is cut, or is not all within the cell; or when an operand may meet
    /// itself.
    [[nodiscard]] bool list(const LeafProblem& problem);
    /// False for polygons that are of no prism along any axis.
    [[nodiscard]] static bool may_be_of_prism(const PolygonRef& polygon);

    [[nodiscard]] std::span<const PrismSideFace> side_faces() const { return side_faces_; }
    /// By position, operand, source and facet.
    [[nodiscard]] std::span<const PrismCap> caps() const { return caps_; }
    [[nodiscard]] std::span<const Coordinate> positions() const { return positions_; }
    /// A facet perpendicular to the axis there.
    [[nodiscard]] const PolygonRef& cap_at(std::size_t position) const { return named_[position]; }
    /// Whether a cap's support has its upper side towards greater positions.
    [[nodiscard]] bool faces_up(const PolygonRef& cap) const;
    [[nodiscard]] std::size_t axis() const { return axis_; }
    /// The edge along the axis of the half of a side face that has one at its `from` (end 0) or
    /// `to` (end 1): numbers of the facet's corners. `edge` is that of the edge.
    struct Upright {
        int low = 0;
        int high = 0;
        int edge = 0;
    };
    [[nodiscard]] Upright upright_edge(const PrismSideFace& side_face, std::size_t end) const;
    [[nodiscard]] FlatCorner flat(const LatticePoint& p) const {
        return {coordinate(p, (axis_ + 1) % 3), coordinate(p, (axis_ + 2) % 3)};
    }
    /// Winding numbers of the operands far away from all of them.
    [[nodiscard]] std::span<const std::uint8_t> outside() const { return outside_; }

private:
    [[nodiscard]] bool may_end_at_caps(const LeafProblem& problem, std::size_t axis);
    [[nodiscard]] bool list_along(const LeafProblem& problem, std::size_t axis);
    [[nodiscard]] bool add(const PolygonRef& ref, LeafIndex operand, bool flipped);
    [[nodiscard]] bool is_grid() const;
    [[nodiscard]] bool join_halves();
    [[nodiscard]] bool find_layers();
    void find_outside(const LeafProblem& problem);

    std::size_t axis_ = 0;
    PoolVector<PrismSideFace> side_faces_;
    PoolVector<PrismCap> caps_;
    std::vector<Coordinate> positions_;
    PoolVector<PolygonRef> named_;
    std::vector<std::uint8_t> outside_;
};

}  // namespace trisect::detail
