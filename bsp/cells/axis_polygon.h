// SPDX-License-Identifier: Apache-2.0
//
// Polygons in axis-perpendicular planes, as integers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// An axis-perpendicular plane. Positions count in 1/192 lattice units, as those of splitting
/// planes do.
struct AxisPlane {
    std::size_t axis = 0;
    int sign = 1;  ///< of its normal's component along the axis
    std::int64_t position = 0;
};

/// The plane that a name means, if it is axis-perpendicular.
[[nodiscard]] std::optional<AxisPlane> axis_plane(const PlaneName& name);

/// An edge along no axis, of a facet across one. In the two other axes, cyclically after the
/// normal's, in lattice units. The polygon is to its left, seen from where the normal's axis
/// points.
struct SlantedEdge {
    std::array<std::int64_t, 2> from{};
    std::array<std::int64_t, 2> to{};
    friend bool operator==(const SlantedEdge&, const SlantedEdge&) = default;
};

/// An axis-perpendicular facet, or a fragment of it whose edges run along axes or are the facet's
/// own: what its slanted edges leave of a box.
struct AxisPolygon {
    PolygonRef ref;
    LeafIndex operand = 0;
    AxisPlane plane;
    std::array<std::int64_t, 3> lo{};  ///< the box, in 1/192 lattice units
    std::array<std::int64_t, 3> hi{};
    std::array<SlantedEdge, 3> slanted{};
    std::size_t slanted_count = 0;
    bool contained = false;  ///< lies in the leaf's cell

    /// False for any other polygon.
    [[nodiscard]] bool read(const PolygonRef& polygon);
    /// Whether it has area in the cell. May say so in vain of a fragment with slanted edges.
    [[nodiscard]] bool meets(const Cell& cell) const;
    [[nodiscard]] std::span<const SlantedEdge> slanted_edges() const {
        return {slanted.data(), slanted_count};
    }

private:
    using Corners = std::array<const LatticePoint*, 3>;
    void read_facet(const Corners& corners);
    [[nodiscard]] bool read_fragment(const Corners& corners);
    void add_slanted(const LatticePoint& from, const LatticePoint& to);
};

}  // namespace trisect::detail
