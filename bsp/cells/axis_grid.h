// SPDX-License-Identifier: Apache-2.0
//
// AxisGrid: the grid of planes of an axis-perpendicular leaf (axis_leaf.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/axis_polygon.h>

namespace trisect::detail {

/// The units of one axis: open intervals between neighbouring planes; those at the ends are the
/// cell's bounding planes.
template <class Number>
class AxisUnits {
public:
    struct Position {
        Number at = 0;
        PlaneName name;
        int sign = 1;  ///< of the plane's normal
    };

    void start() { positions_.clear(); }
    void add(const Position& p) { positions_.push_back(p); }
    /// Sorts; of equal positions the one added first stays.
    void finish(std::size_t axis, const Cell& cell);

    [[nodiscard]] std::size_t count() const { return positions_.size() - 1; }
    /// Plane p bounds the units p - 1 and p.
    [[nodiscard]] const Position& plane(std::size_t p) const { return positions_[p]; }
    [[nodiscard]] std::size_t plane_at(Number position) const;
    /// Twice the middle of a unit.
    [[nodiscard]] Number centre(std::size_t i) const { return centres_[i]; }
    /// The first unit whose centre is at the position or beyond.
    [[nodiscard]] std::size_t first_from(Number position) const;
    /// The unit that begins at the position or holds it.
    [[nodiscard]] std::size_t unit_of(Number position) const;
    /// Bits of the units, one or two, that begin or end at the position or hold it.
    [[nodiscard]] std::uint64_t units_at(Number position) const;

private:
    std::vector<Position> positions_;
    std::vector<Number> centres_;
};

/// A two-dimensional bitmap of units: a word for each row.
inline constexpr std::size_t axis_units_limit = 64;
using UnitRows = std::array<std::uint64_t, axis_units_limit>;

/// Which side of an edge a point is on that is given in units finer than places by `scale`.
template <class Number>
struct AxisEdgeSide {
    Number step_u;
    Number step_v;
    Number from_u;
    Number from_v;
    AxisEdgeSide(const SlantedEdge<Number>& e, std::int64_t scale)
        : step_u(e.to[0] - e.from[0]),
          step_v(e.to[1] - e.from[1]),
          from_u(e.from[0] * scale),
          from_v(e.from[1] * scale) {}
    [[nodiscard]] int turn(Number u, Number v) const {
        using Numbers = AxisNumbers<Number>;
        const auto s = Numbers::multiply(step_u, v - from_v);
        const auto t = Numbers::multiply(step_v, u - from_u);
        return s > t ? 1 : (s < t ? -1 : 0);
    }
    [[nodiscard]] bool leads_left(bool along_u) const { return along_u ? step_v < 0 : step_u > 0; }
};

/// Rows and bits of a bitmap of units in a plane.
struct UnitFrame {
    std::size_t row_axis = 0;
    std::size_t bit_axis = 0;
    /// Of planes across an axis.
    [[nodiscard]] static UnitFrame of(std::size_t axis) {
        return {axis == 2 ? 1U : 2U, axis == 0 ? 1U : 0U};
    }
};

template <class Number>
class AxisGrid {
public:
    using Polygon = AxisPolygon<Number>;
    /// The units that a polygon's box may meet.
    struct Reach {
        std::size_t first_row = 0;
        std::size_t end_row = 0;
        std::uint64_t bits = 0;
    };

    [[nodiscard]] AxisUnits<Number>& units(std::size_t axis) { return units_[axis]; }
    [[nodiscard]] const AxisUnits<Number>& units(std::size_t axis) const { return units_[axis]; }

    [[nodiscard]] Reach reach(const Polygon& polygon, UnitFrame frame) const;
    /// The units of a row whose centres are in the polygon. A centre on an edge counts as if it
    /// were moved, by the same infinitely small step everywhere: so it is in one of two polygons
    /// that share the edge.
    [[nodiscard]] std::uint64_t scan(const Polygon& polygon, UnitFrame frame,
                                     std::size_t row) const;
    /// The units of a row of which the polygon has some area. \pre its box meets the cell.
    [[nodiscard]] std::uint64_t overlapped(const Polygon& polygon, UnitFrame frame,
                                           std::size_t row) const;

private:
    std::array<AxisUnits<Number>, 3> units_;
};

/// Bits [begin, end).
[[nodiscard]] inline std::uint64_t unit_bits(std::size_t begin, std::size_t end) {
    if (begin >= end) return 0;
    const std::uint64_t below_end = end == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
    return below_end & ~((std::uint64_t{1} << begin) - 1);
}

}  // namespace trisect::detail
