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
class AxisUnits {
public:
    struct Position {
        std::int64_t at = 0;
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
    [[nodiscard]] std::size_t plane_at(std::int64_t position) const;
    /// Twice the middle of a unit.
    [[nodiscard]] std::int64_t centre(std::size_t i) const { return centres_[i]; }
    /// The first unit whose centre is at the position or beyond.
    [[nodiscard]] std::size_t first_from(std::int64_t position) const;
    /// The unit that begins at the position or holds it.
    [[nodiscard]] std::size_t unit_of(std::int64_t position) const;
    /// Bits of the units, one or two, that begin or end at the position or hold it.
    [[nodiscard]] std::uint64_t units_at(std::int64_t position) const;

private:
    std::vector<Position> positions_;
    std::vector<std::int64_t> centres_;
};

/// A two-dimensional bitmap of units: a word for each row.
inline constexpr std::size_t axis_units_limit = 64;
using UnitRows = std::array<std::uint64_t, axis_units_limit>;

class AxisGrid {
public:
    /// Rows and bits of a bitmap of units in a plane.
    struct Frame {
        std::size_t row_axis = 0;
        std::size_t bit_axis = 0;
    };
    /// The units that a polygon's box may meet.
    struct Reach {
        std::size_t first_row = 0;
        std::size_t end_row = 0;
        std::uint64_t bits = 0;
    };

    [[nodiscard]] AxisUnits& units(std::size_t axis) { return units_[axis]; }
    [[nodiscard]] const AxisUnits& units(std::size_t axis) const { return units_[axis]; }

    /// Rows and bits of axis-perpendicular planes.
    [[nodiscard]] static Frame frame(std::size_t axis) {
        return {axis == 2 ? 1U : 2U, axis == 0 ? 1U : 0U};
    }
    [[nodiscard]] Reach reach(const AxisPolygon& polygon, Frame frame) const;
    /// The units of a row whose centres are in the polygon. A centre on an edge counts as if it
    /// were moved, by the same infinitely small step everywhere: so it is in one of two polygons
    /// that share the edge.
    [[nodiscard]] std::uint64_t scan(const AxisPolygon& polygon, Frame frame,
                                     std::size_t row) const;
    /// The units of a row of which the polygon has some area. \pre its box meets the cell.
    [[nodiscard]] std::uint64_t overlapped(const AxisPolygon& polygon, Frame frame,
                                           std::size_t row) const;

private:
    std::array<AxisUnits, 3> units_;
};

/// Bits [begin, end).
[[nodiscard]] inline std::uint64_t unit_bits(std::size_t begin, std::size_t end) {
    if (begin >= end) return 0;
    const std::uint64_t below_end = end == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
    return below_end & ~((std::uint64_t{1} << begin) - 1);
}

}  // namespace trisect::detail
