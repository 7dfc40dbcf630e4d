// SPDX-License-Identifier: Apache-2.0
//
// Polygons in axis-perpendicular planes, as integers. Of type Number, see axis_numbers.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/bsp/cells/axis_numbers.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// An axis-perpendicular plane.
template <class Number>
struct AxisPlane {
    std::size_t axis = 0;
    int sign = 1;  ///< of its normal's component along the axis
    Number position = 0;
};

/// The support of an axis-perpendicular facet.
struct AxisSupport {
    std::size_t axis = 0;
    int sign = 1;
    Coordinate at;
};

/// Of a facet's support, if that is axis-perpendicular.
[[nodiscard]] std::optional<AxisSupport> axis_support(const Source& source, std::uint32_t facet);

/// The plane that a name means, if it is axis-perpendicular and the numbers take its coordinate.
template <class Number>
[[nodiscard]] std::optional<AxisPlane<Number>> axis_plane(const PlaneName& name);

/// An edge along no axis, of a facet across one. Places in the two other axes, cyclically after the
/// normal's. The polygon is to its left, seen from where the normal's axis points.
template <class Number>
struct SlantedEdge {
    std::array<Number, 2> from{};
    std::array<Number, 2> to{};
    friend bool operator==(const SlantedEdge&, const SlantedEdge&) = default;
};

/// A box given by positions.
template <class Number>
struct AxisBox {
    std::array<Number, 3> lo{};
    std::array<Number, 3> hi{};

    [[nodiscard]] static AxisBox of(const Cell& cell) {
        AxisBox b;
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = AxisNumbers<Number>::from_fine(cell.lo[k]);
            b.hi[k] = AxisNumbers<Number>::from_fine(cell.hi[k]);
        }
        return b;
    }
};

/// An axis-perpendicular facet, or a fragment of it whose edges run along axes or are the facet's
/// own: what its slanted edges leave of a box.
template <class Number>
struct AxisPolygon {
    PolygonRef ref;
    LeafIndex operand = 0;
    AxisPlane<Number> plane;
    std::array<Number, 3> lo{};  ///< the box, as positions
    std::array<Number, 3> hi{};
    std::array<SlantedEdge<Number>, 3> slanted{};
    std::size_t slanted_count = 0;
    bool contained = false;  ///< lies in the leaf's cell

    /// False for any other polygon, and where the numbers do not take its source.
    [[nodiscard]] bool read(const PolygonRef& polygon);
    /// Whether it has area in a cell. May say so in vain of a fragment with slanted edges.
    [[nodiscard]] bool meets(const AxisBox<Number>& cell) const;
    [[nodiscard]] std::span<const SlantedEdge<Number>> slanted_edges() const {
        return {slanted.data(), slanted_count};
    }

private:
    using Corners = std::array<const LatticePoint*, 3>;
    void read_facet(const Corners& corners);
    [[nodiscard]] bool read_fragment(const Corners& corners);
    void add_slanted(const LatticePoint& from, const LatticePoint& to);
};

/// Whether a polygon is one, of coordinates of either kind.
[[nodiscard]] bool is_axis_polygon(const PolygonRef& polygon);

}  // namespace trisect::detail
