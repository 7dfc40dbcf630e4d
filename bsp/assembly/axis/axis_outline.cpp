// SPDX-License-Identifier: Apache-2.0
//
// The boundary of a union of polygons with disjoint interiors is the sum of their directed sides.
// On a line that sum is a function of the place, and it changes where sides begin and end. So it is
// enough to note the changes, to sort and to add them. Where a slanted side meets a line in a place
// that is no integer two polygons end, one on each side of the slanted line, and their changes
// cancel: both are left out, and all others are integers.

#include <trisect/bsp/assembly/axis/axis_outline.h>

#include <algorithm>
#include <bit>
#include <utility>

#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

// Edge i of the facet itself.
template <class Number>
AxisSide<Number> own_side(const Source& source, std::uint32_t facet, int i, std::size_t axis) {
    const LatticePoint& from = source.corner(facet, i);
    const LatticePoint& to = source.corner(facet, (i + 1) % 3);
    const LatticePoint& third = source.corner(facet, (i + 2) % 3);
    using Numbers = AxisNumbers<Number>;
    AxisSide<Number> side;
    for (std::uint8_t k = 0; k < 2; ++k) {
        const std::size_t across = (axis + 1 + k) % 3;
        if (coordinate(from, across) != coordinate(to, across)) continue;
        side.axis = k;
        side.at = axis_position<Number>(coordinate(from, across));
        side.is_low = coordinate(third, across) > coordinate(from, across);
        return side;
    }
    side.is_slanted = true;
    for (std::size_t k = 0; k < 2; ++k) {
        side.line.from[k] = Numbers::place(coordinate(from, (axis + 1 + k) % 3));
        side.line.to[k] = Numbers::place(coordinate(to, (axis + 1 + k) % 3));
    }
    return side;
}

// way · by / step, if that is an integer. Ways are below 2^62, steps below 2^54.
std::optional<std::int64_t> share_of(std::int64_t way, std::int64_t by, std::int64_t step) {
    const Int128 product = Int128{way} * by;
    if (product % step != 0) return std::nullopt;
    return static_cast<std::int64_t>(product / step);
}

// The product has more than 128 bits unless common factors go first. What is at the beginning of a
// line or at its end is most of what there is.
std::optional<Int128> share_of(Int128 way, Int128 by, Int128 step) {
    constexpr std::int64_t scale = AxisNumbers<Int128>::scale;
    if (way == 0) return 0;
    if (way == step * scale) return by * scale;
    const Int128 common = common_divisor(way, step);
    const Int128 rest = step / common;
    if (by % rest != 0) return std::nullopt;
    return way / common * (by / rest);
}

// More than a rectangle has on one of its axes. Few outlines have fewer, and growing one by one
// takes longer than all else of them.
constexpr std::size_t few_changes = 8;

}  // namespace

template <class Number>
bool read_axis_sides(const PolygonRef& polygon, std::size_t axis,
                     std::vector<AxisSide<Number>>& out) {
    out.clear();
    if (polygon.fragment == nullptr) {
        for (int i = 0; i < 3; ++i)
            out.push_back(own_side<Number>(*polygon.source, polygon.facet, i, axis));
        return true;
    }
    for (const EdgeName& e : polygon.fragment->edges()) {
        if (e.plane.is_edge() && e.plane.facet == polygon.facet &&
            e.plane.source() == polygon.source && !e.above) {
            const auto i = static_cast<int>(e.plane.kind);
            out.push_back(own_side<Number>(*polygon.source, polygon.facet, i, axis));
            continue;
        }
        const auto plane = axis_plane<Number>(e.plane);
        if (!plane || plane->axis == axis) return false;
        AxisSide<Number>& side = out.emplace_back();
        side.axis = plane->axis == (axis + 1) % 3 ? 0 : 1;
        side.at = plane->position;
        side.is_low = e.above == (plane->sign > 0);
    }
    return true;
}

template <class Number>
std::optional<Number> end_of_side(const AxisSide<Number>& side, const AxisSide<Number>& neighbour) {
    using Numbers = AxisNumbers<Number>;
    if (!neighbour.is_slanted) return neighbour.at;
    const SlantedEdge<Number>& line = neighbour.line;
    const std::size_t fixed = side.axis;
    const std::size_t free = 1 - fixed;
    const auto end = share_of(side.at - line.from[fixed] * Numbers::scale,
                              line.to[free] - line.from[free], line.to[fixed] - line.from[fixed]);
    if (!end) return std::nullopt;
    return line.from[free] * Numbers::scale + *end;
}

template <class Number>
void AxisOutline<Number>::add(std::span<const AxisSide<Number>> sides, bool turns_left,
                              bool faces_up) {
    const std::size_t n = sides.size();
    for (std::size_t i = 0; i < n; ++i) {
        const AxisSide<Number>& side = sides[i];
        if (side.is_slanted) continue;
        const AxisSide<Number>& before = sides[i == 0 ? n - 1 : i - 1];
        const AxisSide<Number>& after = sides[i + 1 == n ? 0 : i + 1];
        // Seen from above, with the polygon to the left.
        const bool runs_up = (side.axis == 1) == side.is_low;
        const bool before_is_low = runs_up == turns_left;
        auto& changes = changes_[kind_of(faces_up, side.axis)];
        const auto change = [&](const AxisSide<Number>& end, bool grows) {
            if (const auto place = end_of_side(side, end))
                changes.emplace_back(side.at, *place, grows);
        };
        change(before_is_low ? before : after, runs_up);
        change(before_is_low ? after : before, !runs_up);
    }
}

template <class Number>
void AxisOutline<Number>::add(const Units& units, bool faces_up) {
    add_lines(units, faces_up);
    Units turned;
    const std::size_t rows = units.row_planes.size() - 1;
    std::copy_n(units.rows.begin(), rows, turned.rows.begin());
    transpose(turned.rows, std::max(rows, units.bit_planes.size() - 1));
    turned.row_planes = units.bit_planes;
    turned.bit_planes = units.row_planes;
    turned.row_axis = 1 - units.row_axis;
    add_lines(turned, faces_up);
}

// The lines between rows, in the order of changes.
template <class Number>
void AxisOutline<Number>::add_lines(const Units& units, bool faces_up) {
    auto& changes = changes_[kind_of(faces_up, units.row_axis)];
    if (changes.capacity() == 0) changes.reserve(few_changes);
    const bool low_runs_up = units.row_axis == 1;
    const std::size_t rows = units.row_planes.size() - 1;
    std::uint64_t before = 0;
    for (std::size_t r = 0; r <= rows; ++r) {
        const std::uint64_t here = r < rows ? units.rows[r] : 0;
        const std::uint64_t up = low_runs_up ? here & ~before : before & ~here;
        const std::uint64_t down = (here ^ before) & ~up;
        before = here;
        const Number at = units.row_planes[r];
        for (std::uint64_t turns = (up ^ up << 1) | (down ^ down << 1); turns != 0;
             turns &= turns - 1) {
            const std::uint64_t bit = turns & (~turns + 1);
            const Number place =
                units.bit_planes[static_cast<std::size_t>(std::countr_zero(turns))];
            // What ends here, and what begins.
            if (((up << 1) & ~up & bit) != 0) changes.emplace_back(at, place, false);
            if (((down << 1) & ~down & bit) != 0) changes.emplace_back(at, place, true);
            if ((up & ~(up << 1) & bit) != 0) changes.emplace_back(at, place, true);
            if ((down & ~(down << 1) & bit) != 0) changes.emplace_back(at, place, false);
        }
        constexpr std::size_t most = axis_units_limit;
        if ((up >> (most - 1)) != 0) changes.emplace_back(at, units.bit_planes[most], false);
        if ((down >> (most - 1)) != 0) changes.emplace_back(at, units.bit_planes[most], true);
    }
}

template <class Number>
bool AxisOutline<Number>::add_interval(std::size_t kind, const Change& from, Number to, int cover) {
    using Numbers = AxisNumbers<Number>;
    const auto on_lattice = [](Number position) { return Numbers::is_place(position); };
    if (cover > 1 || cover < -1 || !on_lattice(from.at()) || !on_lattice(from.place()) ||
        !on_lattice(to))
        return false;
    AxisInterval<Number> s;
    s.faces_up = kind >= 2;
    s.axis = static_cast<std::uint8_t>(kind % 2);
    s.is_low = (s.axis == 1) == (cover > 0);
    s.at = Numbers::place_of(from.at());
    s.low = Numbers::place_of(from.place());
    s.high = Numbers::place_of(to);
    const auto number = static_cast<std::uint32_t>(intervals_.size());
    if (runs_.size() == first_run_[kind] || intervals_.back().at != s.at)
        runs_.push_back({number, number});
    runs_.back().end = number + 1;
    intervals_.push_back(s);
    return true;
}

template <class Number>
bool AxisOutline<Number>::add_intervals(std::size_t kind) {
    auto& changes = changes_[kind];
    if (!std::is_sorted(changes.begin(), changes.end())) std::sort(changes.begin(), changes.end());
    int cover = 0;
    Change from;
    for (std::size_t i = 0; i < changes.size();) {
        const Change& here = changes[i];
        int by = 0;
        for (; i < changes.size() && changes[i].is_at_place_of(here); ++i) by += changes[i].by();
        if (by == 0) continue;
        if (cover != 0 &&
            !(here.is_on_line_of(from) && add_interval(kind, from, here.place(), cover)))
            return false;
        cover += by;
        from = here;
    }
    changes = {};
    return cover == 0;
}

template <class Number>
bool AxisOutline<Number>::finish() {
    intervals_.clear();
    runs_.clear();
    std::size_t changes = 0;
    for (const auto& of_kind : changes_) changes += of_kind.size();
    intervals_.reserve(std::min(changes, few_changes));
    runs_.reserve(std::min(changes, few_changes));
    for (std::size_t kind = 0; kind < changes_.size(); ++kind) {
        first_run_[kind] = runs_.size();
        if (!add_intervals(kind)) return false;
    }
    first_run_.back() = runs_.size();
    return true;
}

template <class Number>
std::size_t AxisOutline<Number>::run_at(bool faces_up, std::uint8_t axis, Number at) const {
    const std::size_t kind = kind_of(faces_up, axis);
    std::size_t low = first_run_[kind];
    std::size_t high = first_run_[kind + 1];
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (intervals_[runs_[middle].first].at < at) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < first_run_[kind + 1] && intervals_[runs_[low].first].at == at ? low : runs_.size();
}

template <class Number>
bool AxisOutline<Number>::turns_between(bool faces_up, std::uint8_t axis, Number at, Number low,
                                        Number high) const {
    const std::size_t run = run_at(faces_up, axis, at);
    if (run == runs_.size()) return false;
    // The first that ends beyond `low`.
    const auto on_line = intervals().subspan(runs_[run].first, runs_[run].end - runs_[run].first);
    const auto it = std::ranges::upper_bound(on_line, low, {}, &AxisInterval<Number>::high);
    if (it == on_line.end()) return false;
    return it->high < high || (it->low > low && it->low < high);
}

// The interval that begins where another one ends: one across the other axis, at its end.
template <class Number>
std::size_t AxisOutline<Number>::next_of(const AxisInterval<Number>& s,
                                         const std::vector<bool>& used) const {
    const std::size_t run = run_at(s.faces_up, static_cast<std::uint8_t>(1 - s.axis), s.to());
    if (run == runs_.size()) return intervals_.size();
    const auto begin = intervals_.begin();
    const auto end = begin + runs_[run].end;
    auto it = std::ranges::lower_bound(begin + runs_[run].first, end, s.at, {},
                                       &AxisInterval<Number>::high);
    for (int i = 0; i < 2 && it != end; ++i, ++it)
        if (const auto n = static_cast<std::size_t>(it - begin); it->from() == s.at && !used[n])
            return n;
    return intervals_.size();
}

template <class Number>
PoolVector<std::uint32_t> AxisOutline<Number>::loops(bool faces_up) const {
    const auto interval_at = [&](std::size_t run) {
        return run < runs_.size() ? runs_[run].first : intervals_.size();
    };
    const std::size_t begin = interval_at(first_run_[kind_of(faces_up, 0)]);
    const std::size_t end = interval_at(first_run_[kind_of(faces_up, 1) + 1]);
    std::vector<bool> used(intervals_.size(), false);
    PoolVector<std::uint32_t> ordered;
    ordered.reserve(end - begin);
    for (std::size_t start = begin; start < end; ++start) {
        for (std::size_t i = start; i < end && !used[i]; i = next_of(intervals_[i], used)) {
            used[i] = true;
            ordered.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return ordered;
}

template bool read_axis_sides(const PolygonRef&, std::size_t, std::vector<AxisSide<Int128>>&);
template bool read_axis_sides(const PolygonRef&, std::size_t, std::vector<AxisSide<std::int64_t>>&);
template std::optional<Int128> end_of_side(const AxisSide<Int128>&, const AxisSide<Int128>&);
template std::optional<std::int64_t> end_of_side(const AxisSide<std::int64_t>&,
                                                 const AxisSide<std::int64_t>&);
template class AxisOutline<std::int64_t>;
template class AxisOutline<Int128>;

}  // namespace trisect::detail
