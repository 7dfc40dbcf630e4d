// SPDX-License-Identifier: Apache-2.0
//
// Walls: side faces of prisms that have any facets.
// A plate whose sides are grids has such, and so has what another program triangulated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/leaf/prism/prism_side_face.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A facet parallel to an axis or perpendicular to it, seen along the axis.
struct FlatFacet {
    std::array<FlatCorner, 3> corners;
    std::array<Coordinate, 3> heights;

    FlatFacet(const PolygonRef& ref, std::size_t axis);
    [[nodiscard]] bool is_cap() const {
        return heights[0] == heights[1] && heights[0] == heights[2];
    }
    /// Parallel to the axis; exact. \pre no cap
    [[nodiscard]] bool is_upright() const { return turn(corners[0], corners[1], corners[2]) == 0; }
};

/// Facets of one mesh in one plane along the axis that are connected by edges, where they fill a
/// rectangle.
class PrismWalls {
public:
    /// The four sides: from the lower end along the axis, or from `from` to `to`.
    enum Side : std::uint8_t { AtFrom, AtTo, Bottom, Top };

    void clear();
    /// The walls of an operand become side faces. False where its facets that are no caps are not
    /// parallel to the axis, or do not fill rectangles. \pre all facets of one source, which has no
    /// edge with the same two facets on both sides. Time O(n log n).
    [[nodiscard]] bool add(std::span<const PolygonRef> polygons, LeafIndex operand, bool flipped,
                           std::size_t axis, PoolVector<PrismSideFace>& out);

    /// In the order of the list.
    [[nodiscard]] std::span<const PolygonRef> facets(LeafIndex wall) const;
    /// All corners of facets on a side, one for each place, in order.
    [[nodiscard]] std::span<const PrismCorner> side(LeafIndex wall, Side side) const;
    [[nodiscard]] PrismCorner corner(LeafIndex wall, std::size_t end, bool high) const {
        const auto s = side(wall, end == 0 ? AtFrom : AtTo);
        return high ? s.back() : s.front();
    }
    /// The smallest number of a facet.
    [[nodiscard]] std::uint32_t first_facet(LeafIndex wall) const {
        return walls_[static_cast<std::size_t>(wall)].first_facet;
    }
    /// Whether the facets are of several faces of the mesh.
    [[nodiscard]] bool has_several_faces(LeafIndex wall) const {
        return walls_[static_cast<std::size_t>(wall)].several_faces;
    }

private:
    struct Wall {
        std::size_t facets_begin = 0;
        std::size_t facets_end = 0;
        std::array<std::size_t, 5> corners{};  // where each side begins, and the last one ends
        std::uint32_t first_facet = 0;
        bool several_faces = false;
    };
    // An edge of a facet, by its corners in the mesh.
    struct Edge {
        std::uint32_t low = 0;
        std::uint32_t high = 0;
        std::uint32_t facet = 0;  // in the list
        std::uint8_t edge = 0;
        bool turned = false;  // from `high` to `low`
    };
    // A corner on the rim of a wall.
    struct RimCorner {
        std::uint32_t group = 0;
        Side side = AtFrom;
        bool begins_edge = false;
        std::uint8_t corner = 0;
        Coordinate at;
        std::uint32_t facet = 0;  // in the list
    };
    struct Group {
        FlatCorner from{};
        FlatCorner to{};
        Coordinate lo;
        Coordinate hi;
        std::size_t next = 0;  // in facets_, where the next one of it goes
        std::size_t count = 0;
    };

    [[nodiscard]] bool list_facets(std::span<const PolygonRef> polygons, std::size_t axis);
    [[nodiscard]] bool join_neighbours();
    void number_groups();
    [[nodiscard]] bool find_rims();
    [[nodiscard]] bool add_rim(const Edge& edge);
    void place_facets();
    void add_wall(std::uint32_t group, std::span<const RimCorner> rim, LeafIndex operand,
                  bool flipped, PoolVector<PrismSideFace>& out);
    [[nodiscard]] std::uint32_t root(std::uint32_t facet);

    std::vector<Wall> walls_;
    std::vector<PolygonRef> facets_;
    std::vector<PrismCorner> corners_;
    // Of the operand in the making: facets that are no caps.
    std::vector<PolygonRef> listed_;
    std::vector<FlatFacet> flat_;
    std::vector<Edge> edges_;
    std::vector<Edge> rim_edges_;
    std::vector<std::uint32_t> root_;
    std::vector<std::uint32_t> group_of_;
    std::vector<Group> groups_;
    std::vector<RimCorner> rims_;
};

}  // namespace trisect::detail
