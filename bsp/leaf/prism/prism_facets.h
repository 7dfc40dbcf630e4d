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
#include <trisect/bsp/leaf/prism/prism_side_face.h>
#include <trisect/bsp/leaf/prism/prism_walls.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

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
    /// itself. With `takes_walls` rectangles may have any facets. \pre then each operand is all
    /// facets of one source. By several threads where there are many; the outcome is the same.
    [[nodiscard]] bool list(const LeafProblem& problem, bool takes_walls = false,
                            std::uint32_t threads = 1);
    /// False for polygons that are of no prism along any axis, or of a wall of other facets than
    /// halves.
    [[nodiscard]] static bool may_be_of_prism(const PolygonRef& polygon);
    /// False for polygons that are of no prism along any axis.
    [[nodiscard]] static bool may_be_of_wall(const PolygonRef& polygon);

    [[nodiscard]] std::span<const PrismSideFace> side_faces() const { return side_faces_; }
    /// By position, operand, source and facet.
    [[nodiscard]] std::span<const PrismCap> caps() const { return caps_; }
    [[nodiscard]] std::span<const Coordinate> positions() const { return positions_; }
    /// A facet perpendicular to the axis there.
    [[nodiscard]] const PolygonRef& cap_at(std::size_t position) const { return named_[position]; }
    /// Whether a cap's support has its upper side towards greater positions.
    [[nodiscard]] bool faces_up(const PolygonRef& cap) const;
    [[nodiscard]] std::size_t axis() const { return axis_; }
    /// The corner of the operand's mesh in which a side face has its lower or upper corner at
    /// `from` (end 0) or `to` (end 1).
    [[nodiscard]] PrismCorner corner_of(const PrismSideFace& w, std::size_t end, bool high) const {
        if (w.wall >= 0) return walls_.corner(w.wall, end, high);
        return {w.facets[end].facet, high ? w.upright[end].high : w.upright[end].low};
    }
    [[nodiscard]] const PrismWalls& walls() const { return walls_; }
    [[nodiscard]] FlatCorner flat(const LatticePoint& p) const {
        return {coordinate(p, (axis_ + 1) % 3), coordinate(p, (axis_ + 2) % 3)};
    }
    /// Winding numbers of the operands far away from all of them.
    [[nodiscard]] std::span<const std::uint8_t> outside() const { return outside_; }

private:
    [[nodiscard]] bool may_be_along(const LeafProblem& problem, std::size_t axis);
    [[nodiscard]] bool list_along(const LeafProblem& problem, std::size_t axis, bool takes_walls);
    [[nodiscard]] bool list_operand(const LeafProblem& problem, std::size_t operand,
                                    bool takes_walls);
    [[nodiscard]] bool list_caps(const LeafProblem& problem, std::size_t operand);
    // Of the halves of an operand's side faces: false where a facet is of none.
    struct Halves {
        bool all_in_cell = true;
        bool fit = true;
        std::size_t loose = 0;  // that were listed without another one
    };
    [[nodiscard]] Halves list_halves(const LeafProblem& problem, std::size_t operand);
    [[nodiscard]] bool add_half(const PolygonRef& ref, const FlatFacet& flat, LeafIndex operand,
                                bool flipped);
    [[nodiscard]] bool is_grid() const;
    [[nodiscard]] bool join_halves(std::size_t first);
    [[nodiscard]] bool end_at_caps(std::size_t first, std::size_t first_cap) const;
    [[nodiscard]] bool find_layers();
    void sort_caps();
    [[nodiscard]] Coordinate height_of(const PrismCap& c) const {
        return coordinate(c.ref.source->corner(c.ref.facet, 0), axis_);
    }
    [[nodiscard]] std::vector<Coordinate> heights_of(std::span<const PrismCap> caps) const;
    void find_outside(const LeafProblem& problem);

    std::uint32_t threads_ = 1;
    std::size_t axis_ = 0;
    PoolVector<PrismSideFace> side_faces_;
    PrismWalls walls_;
    PoolVector<PrismCap> caps_;
    std::vector<Coordinate> positions_;
    PoolVector<PolygonRef> named_;
    std::vector<std::uint8_t> outside_;
};

}  // namespace trisect::detail
