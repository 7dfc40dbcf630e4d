// SPDX-License-Identifier: Apache-2.0
//
// ShiftedPoints: exact answers about vertices of outlined solids whose operands are moved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/special_position.h>

namespace trisect::detail {

/// What doubles do not decide. So moved (operand_shifts.h), meshes are in general position, and
/// every answer is -1 or 1. Facets are numbers of Crossings. Where an answer needs the moves, all
/// facets that it is about are noted.
class ShiftedPoints {
public:
    ShiftedPoints(const ManyMeshes& meshes, SpecialPosition& special)
        : meshes_(meshes), special_(special) {}

    [[nodiscard]] const ManyMeshes& meshes() const { return meshes_; }

    struct Side {
        int sign = 0;
        bool by_moves = false;  ///< the vertex is in the plane otherwise
    };
    /// Below or above a facet of another operand. Nothing is noted.
    [[nodiscard]] Side side(const OutlineVertex& vertex, std::uint32_t facet) const;
    /// Notes a facet with a vertex of a part of `own` in its plane.
    void note_side(const OutlineVertex& vertex, std::uint32_t own, std::uint32_t facet) const;
    /// Notes two facets that have a segment in common that may have no length.
    void note_short(const FacetCrossing& crossing) const {
        note({crossing.facets[0], crossing.facets[1]});
    }
    /// The order of two facets along an edge of another one that goes through both planes: -1 where
    /// `one` comes first.
    [[nodiscard]] int order_on_edge(std::uint32_t facet, std::int8_t edge, std::uint32_t one,
                                    std::uint32_t other) const;
    /// Along the line of the first two facets, in the direction of the product of their normals.
    [[nodiscard]] int order_on_line(const std::array<std::uint32_t, 2>& line, std::uint32_t one,
                                    std::uint32_t other) const;
    /// 1 where the plane of a facet comes behind an end of a crossing on its line, -1 before it.
    [[nodiscard]] int order_to_end(const FacetCrossing& crossing, std::size_t end,
                                   std::uint32_t facet) const;
    /// Where three facets meet, without the moves. \pre their normals are independent
    [[nodiscard]] Approximation meeting(const std::array<std::uint32_t, 3>& facets) const;
    /// The axis along which the product of two facets' normals is longest, and its sign there.
    struct Direction {
        std::size_t axis = 0;
        int sign = 0;
    };
    [[nodiscard]] Direction direction(std::uint32_t first, std::uint32_t second) const;

    /// The order of a vertex and a corner of another operand along an axis: 1 where the vertex is
    /// farther. Nothing is noted.
    [[nodiscard]] int order_along(const OutlineVertex& vertex, const OutlineVertex& corner,
                                  std::size_t axis) const;
    /// The same along the first axis of the point of an edge of an outline that is at the corner's
    /// height along the second one. `solid`: whose edge it is. \pre there is one
    [[nodiscard]] int order_at_height(const OutlinedSolid& solid, std::uint32_t facet,
                                      const OutlinedSolid::Edge& edge, const OutlineVertex& corner,
                                      const std::array<std::size_t, 2>& axes) const;
    /// The sign of a facet's normal along an axis.
    [[nodiscard]] int slope(std::uint32_t facet, std::size_t axis) const;
    /// side() of a corner.
    [[nodiscard]] int side_of_corner(const OutlineVertex& corner, std::uint32_t facet) const;

private:
    void note(std::initializer_list<std::uint32_t> facets) const;
    [[nodiscard]] int side_of_plane(const OutlineVertex& vertex, std::uint32_t facet) const;

    const ManyMeshes& meshes_;
    SpecialPosition& special_;
};

}  // namespace trisect::detail
