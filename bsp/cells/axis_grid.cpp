// SPDX-License-Identifier: Apache-2.0
//
// Positions are below 2^61 in 1/192 units, centres below 2^62 in 1/384. An edge's step has 54 bits
// in lattice units, a centre seen from its end 63: their products fit into 128.

#include <trisect/bsp/cells/axis_grid.h>

#include <algorithm>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

constexpr std::int64_t centre_scale = 2 * splitting_scale;  // of lattice units

}  // namespace

void AxisUnits::finish(std::size_t axis, const Cell& cell) {
    const auto splitter = [&](std::int64_t at) {
        return Position{at, PlaneName::splitter(static_cast<int>(axis), at), 1};
    };
    std::erase_if(positions_, [&](const Position& p) {
        return p.at <= cell.lo[axis] || p.at >= cell.hi[axis];
    });
    positions_.push_back(splitter(cell.lo[axis]));
    positions_.push_back(splitter(cell.hi[axis]));
    const auto same = [](const Position& a, const Position& b) { return a.at == b.at; };
    std::stable_sort(positions_.begin(), positions_.end(),
                     [](const Position& a, const Position& b) { return a.at < b.at; });
    positions_.erase(std::unique(positions_.begin(), positions_.end(), same), positions_.end());
    centres_.clear();
    for (std::size_t i = 0; i + 1 < positions_.size(); ++i)
        centres_.push_back(positions_[i].at + positions_[i + 1].at);
}

std::size_t AxisUnits::plane_at(std::int64_t position) const {
    const auto at =
        std::lower_bound(positions_.begin(), positions_.end(), position,
                         [](const Position& p, std::int64_t value) { return p.at < value; });
    return static_cast<std::size_t>(at - positions_.begin());
}

std::size_t AxisUnits::first_from(std::int64_t position) const {
    return static_cast<std::size_t>(
        std::lower_bound(centres_.begin(), centres_.end(), 2 * position) - centres_.begin());
}

std::size_t AxisUnits::unit_of(std::int64_t position) const {
    const std::size_t p = plane_at(position);
    return positions_[p].at == position ? p : p - 1;
}

std::uint64_t AxisUnits::units_at(std::int64_t position) const {
    const std::size_t p = plane_at(position);
    if (p == positions_.size() || (p == 0 && positions_[p].at != position)) return 0;
    const std::size_t end = positions_[p].at == position ? std::min(p + 1, count()) : p;
    return unit_bits(p == 0 ? 0 : p - 1, end);
}

AxisGrid::Reach AxisGrid::reach(const AxisPolygon& polygon, Frame frame) const {
    const auto first = [&](std::size_t axis, std::int64_t position) {
        return units_[axis].first_from(position);
    };
    return {first(frame.row_axis, polygon.lo[frame.row_axis]),
            first(frame.row_axis, polygon.hi[frame.row_axis]),
            unit_bits(first(frame.bit_axis, polygon.lo[frame.bit_axis]),
                      first(frame.bit_axis, polygon.hi[frame.bit_axis]))};
}

namespace {

// Along a row the units to the left of an edge are the first ones or the last ones; `leads_left`
// when going on leads to the left side.
template <class IsLeft>
std::uint64_t units_left(std::size_t begin, std::size_t end, bool leads_left, IsLeft is_left) {
    std::size_t low = begin;
    std::size_t high = end;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (is_left(middle) == leads_left) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return leads_left ? unit_bits(low, end) : unit_bits(begin, low);
}

// Which side of an edge a point is on that is given in 1/scale lattice units.
struct EdgeSide {
    Int128 step_u;
    Int128 step_v;
    Int128 from_u;
    Int128 from_v;
    EdgeSide(const SlantedEdge& e, std::int64_t scale)
        : step_u(e.to[0] - e.from[0]),
          step_v(e.to[1] - e.from[1]),
          from_u(Int128{e.from[0]} * scale),
          from_v(Int128{e.from[1]} * scale) {}
    [[nodiscard]] int turn(std::int64_t u, std::int64_t v) const {
        const Int128 s = step_u * (v - from_v);
        const Int128 t = step_v * (u - from_u);
        return s > t ? 1 : (s < t ? -1 : 0);
    }
    [[nodiscard]] bool leads_left(bool along_u) const { return along_u ? step_v < 0 : step_u > 0; }
};

}  // namespace

std::uint64_t AxisGrid::scan(const AxisPolygon& polygon, Frame frame, std::size_t row) const {
    const AxisUnits& units = units_[frame.bit_axis];
    const std::int64_t at = units_[frame.row_axis].centre(row);
    if (at < 2 * polygon.lo[frame.row_axis] || at >= 2 * polygon.hi[frame.row_axis]) return 0;
    const std::size_t begin = units.first_from(polygon.lo[frame.bit_axis]);
    const std::size_t end = units.first_from(polygon.hi[frame.bit_axis]);
    const bool along_u = frame.bit_axis == (polygon.plane.axis + 1) % 3;
    std::uint64_t bits = unit_bits(begin, end);
    for (const SlantedEdge& e : polygon.slanted_edges()) {
        const EdgeSide side(e, centre_scale);
        bits &= units_left(begin, end, side.leads_left(along_u), [&](std::size_t bit) {
            const std::int64_t c = units.centre(bit);
            const int turn = side.turn(along_u ? c : at, along_u ? at : c);
            return turn != 0 ? turn > 0 : side.step_v < 0;
        });
    }
    return bits;
}

// A line that separates two convex polygons runs along an edge of one of them.
std::uint64_t AxisGrid::overlapped(const AxisPolygon& polygon, Frame frame, std::size_t row) const {
    const AxisUnits& units = units_[frame.bit_axis];
    const AxisUnits& rows = units_[frame.row_axis];
    const std::int64_t low = rows.plane(row).at;
    const std::int64_t high = rows.plane(row + 1).at;
    if (polygon.lo[frame.row_axis] >= high || polygon.hi[frame.row_axis] <= low) return 0;
    const std::size_t begin =
        units.unit_of(std::max(polygon.lo[frame.bit_axis], units.plane(0).at));
    const std::size_t end =
        units.plane_at(std::min(polygon.hi[frame.bit_axis], units.plane(units.count()).at));
    const bool along_u = frame.bit_axis == (polygon.plane.axis + 1) % 3;
    std::uint64_t bits = unit_bits(begin, end);
    for (const SlantedEdge& e : polygon.slanted_edges()) {
        const EdgeSide side(e, splitting_scale);
        bits &= units_left(begin, end, side.leads_left(along_u), [&](std::size_t bit) {
            // The corner of the unit that is farthest to the left.
            const std::int64_t first = units.plane(bit).at;
            const std::int64_t last = units.plane(bit + 1).at;
            const bool is_low_u = side.step_v > 0;
            const bool is_low_v = side.step_u <= 0;
            return along_u ? side.turn(is_low_u ? first : last, is_low_v ? low : high) > 0
                           : side.turn(is_low_u ? low : high, is_low_v ? first : last) > 0;
        });
    }
    return bits;
}

}  // namespace trisect::detail
