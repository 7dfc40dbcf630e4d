// SPDX-License-Identifier: Apache-2.0
//
// A step of an edge has one bit more than a place, and a centre seen from an edge's end one more
// than a sum of positions: their products fit into AxisNumbers' Product.

#include <trisect/bsp/cells/axis_grid.h>

#include <algorithm>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

// Of places.
template <class Number>
constexpr std::int64_t centre_scale = 2 * AxisNumbers<Number>::scale;

}  // namespace

template <class Number>
void AxisUnits<Number>::finish(std::size_t axis, const Cell& cell) {
    const auto splitter = [&](std::int64_t at) {
        return Position{AxisNumbers<Number>::from_fine(at),
                        PlaneName::splitter(static_cast<int>(axis), at), 1};
    };
    const Position low = splitter(cell.lo[axis]);
    const Position high = splitter(cell.hi[axis]);
    std::erase_if(positions_, [&](const Position& p) { return p.at <= low.at || p.at >= high.at; });
    positions_.push_back(low);
    positions_.push_back(high);
    const auto same = [](const Position& a, const Position& b) { return a.at == b.at; };
    std::stable_sort(positions_.begin(), positions_.end(),
                     [](const Position& a, const Position& b) { return a.at < b.at; });
    positions_.erase(std::unique(positions_.begin(), positions_.end(), same), positions_.end());
    centres_.clear();
    for (std::size_t i = 0; i + 1 < positions_.size(); ++i)
        centres_.push_back(positions_[i].at + positions_[i + 1].at);
}

template <class Number>
std::size_t AxisUnits<Number>::plane_at(Number position) const {
    const auto at = std::lower_bound(positions_.begin(), positions_.end(), position,
                                     [](const Position& p, Number value) { return p.at < value; });
    return static_cast<std::size_t>(at - positions_.begin());
}

template <class Number>
std::size_t AxisUnits<Number>::first_from(Number position) const {
    return static_cast<std::size_t>(
        std::lower_bound(centres_.begin(), centres_.end(), 2 * position) - centres_.begin());
}

template <class Number>
std::size_t AxisUnits<Number>::unit_of(Number position) const {
    const std::size_t p = plane_at(position);
    return positions_[p].at == position ? p : p - 1;
}

template <class Number>
std::uint64_t AxisUnits<Number>::units_at(Number position) const {
    const std::size_t p = plane_at(position);
    if (p == positions_.size() || (p == 0 && positions_[p].at != position)) return 0;
    const std::size_t end = positions_[p].at == position ? std::min(p + 1, count()) : p;
    return unit_bits(p == 0 ? 0 : p - 1, end);
}

template <class Number>
auto AxisGrid<Number>::reach(const Polygon& polygon, UnitFrame frame) const -> Reach {
    const auto first = [&](std::size_t axis, Number position) {
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

}  // namespace

template <class Number>
std::uint64_t AxisGrid<Number>::scan(const Polygon& polygon, UnitFrame frame,
                                     std::size_t row) const {
    const AxisUnits<Number>& units = units_[frame.bit_axis];
    const Number at = units_[frame.row_axis].centre(row);
    if (at < 2 * polygon.lo[frame.row_axis] || at >= 2 * polygon.hi[frame.row_axis]) return 0;
    const std::size_t begin = units.first_from(polygon.lo[frame.bit_axis]);
    const std::size_t end = units.first_from(polygon.hi[frame.bit_axis]);
    const bool along_u = frame.bit_axis == (polygon.plane.axis + 1) % 3;
    std::uint64_t bits = unit_bits(begin, end);
    for (const SlantedEdge<Number>& e : polygon.slanted_edges()) {
        const AxisEdgeSide<Number> side(e, centre_scale<Number>);
        bits &= units_left(begin, end, side.leads_left(along_u), [&](std::size_t bit) {
            const Number c = units.centre(bit);
            const int turn = side.turn(along_u ? c : at, along_u ? at : c);
            return turn != 0 ? turn > 0 : side.step_v < 0;
        });
    }
    return bits;
}

// A line that separates two convex polygons runs along an edge of one of them.
template <class Number>
std::uint64_t AxisGrid<Number>::overlapped(const Polygon& polygon, UnitFrame frame,
                                           std::size_t row) const {
    const AxisUnits<Number>& units = units_[frame.bit_axis];
    const AxisUnits<Number>& rows = units_[frame.row_axis];
    const Number low = rows.plane(row).at;
    const Number high = rows.plane(row + 1).at;
    if (polygon.lo[frame.row_axis] >= high || polygon.hi[frame.row_axis] <= low) return 0;
    const std::size_t begin =
        units.unit_of(std::max(polygon.lo[frame.bit_axis], units.plane(0).at));
    const std::size_t end =
        units.plane_at(std::min(polygon.hi[frame.bit_axis], units.plane(units.count()).at));
    const bool along_u = frame.bit_axis == (polygon.plane.axis + 1) % 3;
    std::uint64_t bits = unit_bits(begin, end);
    for (const SlantedEdge<Number>& e : polygon.slanted_edges()) {
        const AxisEdgeSide<Number> side(e, AxisNumbers<Number>::scale);
        bits &= units_left(begin, end, side.leads_left(along_u), [&](std::size_t bit) {
            // The corner of the unit that is farthest to the left.
            const Number first = units.plane(bit).at;
            const Number last = units.plane(bit + 1).at;
            const bool is_low_u = side.step_v > 0;
            const bool is_low_v = side.step_u <= 0;
            return along_u ? side.turn(is_low_u ? first : last, is_low_v ? low : high) > 0
                           : side.turn(is_low_u ? low : high, is_low_v ? first : last) > 0;
        });
    }
    return bits;
}

template class AxisUnits<std::int64_t>;
template class AxisUnits<Int128>;
template class AxisGrid<std::int64_t>;
template class AxisGrid<Int128>;

}  // namespace trisect::detail
