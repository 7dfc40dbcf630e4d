// SPDX-License-Identifier: Apache-2.0
//
// AxisOutline: the outline of a union of coplanar axis-perpendicular polygons.
// All arithmetic is in integers, see axis_numbers.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/axis_grid.h>
#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// A side of an axis-perpendicular polygon. The two other axes come cyclically after that one: they
/// are numbered 0 and 1.
template <class Number>
struct AxisSide {
    bool is_slanted = false;
    bool is_low = false;       ///< the polygon is on the higher side of it; not of slanted ones
    std::uint8_t axis = 0;     ///< 0 or 1: it lies across that one
    Number at = 0;             ///< a position
    SlantedEdge<Number> line;  ///< of slanted ones
};

/// The sides of a polygon across `axis`, in its order, into `out`. False for sides that are slanted
/// without being edges of the polygon's facet.
template <class Number>
[[nodiscard]] bool read_axis_sides(const PolygonRef& polygon, std::size_t axis,
                                   std::vector<AxisSide<Number>>& out);

/// The position where a side ends at its neighbour in a polygon, along the other axis; nothing when
/// that is no integer.
template <class Number>
[[nodiscard]] std::optional<Number> end_of_side(const AxisSide<Number>& side,
                                                const AxisSide<Number>& neighbour);

/// A straight interval of an outline; the region that faces outwards is to its left, seen from
/// outside.
template <class Number>
struct AxisInterval {
    bool faces_up = false;  ///< the outside is on the higher side of the plane
    std::uint8_t axis = 0;  ///< 0 or 1: it lies across that one
    bool is_low = false;    ///< the region is on the higher side of it
    Number at = 0;          ///< a place, as are
    Number low = 0;         ///< its ends along the other axis
    Number high = 0;
    [[nodiscard]] bool runs_up() const { return ((axis == 1) == is_low) == faces_up; }
    [[nodiscard]] Number from() const { return runs_up() ? low : high; }
    [[nodiscard]] Number to() const { return runs_up() ? high : low; }
};

/// Where the number of polygons on the one side of a line less that on the other changes by one:
/// positions of line and place, and whether it grows. Of whole coordinates in one integer, as most
/// of the time goes into sorting.
template <class Number>
class AxisChange;

template <>
class AxisChange<std::int64_t> {
public:
    AxisChange() = default;
    AxisChange(std::int64_t at, std::int64_t place, bool grows)
        : key_((Int128{at + offset} << (bits + 1)) | (Int128{place + offset} << 1) |
               (grows ? 1 : 0)) {}
    [[nodiscard]] std::int64_t at() const { return place_from(bits + 1); }
    [[nodiscard]] std::int64_t place() const { return place_from(1); }
    [[nodiscard]] int by() const { return (key_ & 1) != 0 ? 1 : -1; }
    [[nodiscard]] bool is_on_line_of(const AxisChange& o) const {
        return key_ >> (bits + 1) == o.key_ >> (bits + 1);
    }
    [[nodiscard]] bool is_at_place_of(const AxisChange& o) const {
        return key_ >> 1 == o.key_ >> 1;
    }
    friend bool operator<(const AxisChange& a, const AxisChange& b) { return a.key_ < b.key_; }

private:
    static constexpr int bits = 63;
    static constexpr std::int64_t offset = std::int64_t{1} << (bits - 1);
    static_assert(universe_limit < offset);
    [[nodiscard]] std::int64_t place_from(int shift) const {
        constexpr Int128 mask = (Int128{1} << bits) - 1;
        return static_cast<std::int64_t>((key_ >> shift) & mask) - offset;
    }
    Int128 key_ = 0;
};

template <>
class AxisChange<Int128> {
public:
    AxisChange() = default;
    AxisChange(Int128 at, Int128 place, bool grows) : at_(at), end_(2 * place + (grows ? 1 : 0)) {}
    [[nodiscard]] Int128 at() const { return at_; }
    [[nodiscard]] Int128 place() const { return end_ >> 1; }
    [[nodiscard]] int by() const { return (end_ & 1) != 0 ? 1 : -1; }
    [[nodiscard]] bool is_on_line_of(const AxisChange& o) const { return at_ == o.at_; }
    [[nodiscard]] bool is_at_place_of(const AxisChange& o) const {
        return at_ == o.at_ && place() == o.place();
    }
    friend bool operator<(const AxisChange& a, const AxisChange& b) {
        return a.at_ != b.at_ ? a.at_ < b.at_ : a.end_ < b.end_;
    }

private:
    Int128 at_ = 0;
    Int128 end_ = 0;  // the place, and a bit for the growth
};

/// Adds up the sides of polygons. What two of them have in common runs both ways and vanishes, be
/// it on a bounding plane of a cell or on a line that cut both. Slanted sides are left out: the
/// caller has shown that they cancel. O(n log n).
template <class Number>
class AxisOutline {
public:
    /// A polygon of which the outside is above the plane, or below. `turns_left`: its sides come
    /// counter-clockwise seen from above.
    void add(std::span<const AxisSide<Number>> sides, bool turns_left, bool faces_up);

    /// Area of the bits of a layer of units.
    struct Units {
        UnitRows rows{};
        std::uint8_t row_axis = 0;  ///< 0 or 1: rows lie along the other one
        std::span<const Number> row_planes;
        std::span<const Number> bit_planes;
    };
    void add(const Units& units, bool faces_up);

    /// What is left, as maximal intervals, sorted by facing, axis, place and ends. False when
    /// polygons overlap, or an end is not on the lattice.
    [[nodiscard]] bool finish();
    [[nodiscard]] std::span<const AxisInterval<Number>> intervals() const { return intervals_; }
    /// The intervals [first, end) are all that lie on one line with one facing, in their order.
    struct Run {
        std::uint32_t first = 0;
        std::uint32_t end = 0;
    };
    [[nodiscard]] std::span<const Run> runs() const { return runs_; }
    /// The number of a run; runs().size() if there is none.
    [[nodiscard]] std::size_t run_at(bool faces_up, std::uint8_t axis, Number at) const;
    /// Whether an interval of one facing ends strictly between two places of a line.
    [[nodiscard]] bool turns_between(bool faces_up, std::uint8_t axis, Number at, Number low,
                                     Number high) const;
    /// Puts rank(i, place) for the places of all intervals, along axis i (0 or 1). The ranks are in
    /// the order of the places.
    template <class Rank>
    void rank_places(Rank rank) {
        for (AxisInterval<Number>& s : intervals_) {
            s.at = rank(s.axis, s.at);
            s.low = rank(1 - s.axis, s.low);
            s.high = rank(1 - s.axis, s.high);
        }
    }
    /// Numbers of all intervals with one facing, each behind the one that it continues, loop after
    /// loop.
    [[nodiscard]] PoolVector<std::uint32_t> loops(bool faces_up) const;

private:
    using Change = AxisChange<Number>;
    static constexpr std::size_t kind_of(bool faces_up, std::uint8_t axis) {
        return (faces_up ? 2U : 0U) + axis;
    }
    void add_lines(const Units& units, bool faces_up);
    [[nodiscard]] bool add_intervals(std::size_t kind);
    [[nodiscard]] std::size_t next_of(const AxisInterval<Number>& s,
                                      const std::vector<bool>& used) const;
    [[nodiscard]] bool add_interval(std::size_t kind, const Change& from, Number to, int cover);

    std::array<PoolVector<Change>, 4> changes_;  // by facing and axis
    PoolVector<AxisInterval<Number>> intervals_;
    std::vector<Run> runs_;
    std::array<std::size_t, 5> first_run_{};  // by facing and axis
};

}  // namespace trisect::detail
