// SPDX-License-Identifier: Apache-2.0
//
// Boxes and cells of the partition.
//
// A splitting plane lies at a third of a lattice unit, so no lattice point lies on one, and a
// closed box of lattice points is on one side of a splitting plane or truly crosses it. That makes
// closed cells as good as half-open ones: nothing is listed twice because it ends at a splitting
// plane. No fraction with a power of two below the line is a third, so no double at all lies on
// one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Positions of splitting planes and reference points count in 1/192 of the lattice unit. Those of
/// splitting planes are odd and no multiples of three, those of reference points even; multiples of
/// three are doubles.
inline constexpr std::int64_t splitting_scale = 192;
inline constexpr std::int64_t dyadic_scale = splitting_scale / 3;
/// The offset of splitting planes from lattice positions, in 1/192 units. Solids whose coordinates
/// have fractions are divided by no others.
inline constexpr std::uint32_t usual_splitting_offset = 61;

namespace cell_rounding {
/// The largest doubles below a splitting plane's distance from the lattice planes on both sides.
inline constexpr double to_lower = usual_splitting_offset / 192.0;
inline constexpr double to_upper = (splitting_scale - usual_splitting_offset) / 192.0;
static_assert(static_cast<std::int64_t>(to_lower * 0x1p54) * splitting_scale <
              std::int64_t{usual_splitting_offset} << 54);
static_assert(static_cast<std::int64_t>(to_upper * 0x1p53) * splitting_scale <
              std::int64_t{splitting_scale - usual_splitting_offset} << 53);
}  // namespace cell_rounding

/// The position of a coordinate among lattice planes: p where it lies between the splitting planes
/// of usual offset above the lattice planes p - 1 and p. A whole number is its own position,
/// whatever the offset.
[[nodiscard]] constexpr std::int64_t position_of(Coordinate c) {
    const std::int64_t whole = c.to_integer();                       // towards zero
    const double rest = c.to_double() - static_cast<double>(whole);  // exact
    return whole + (rest > cell_rounding::to_lower ? 1 : 0) -
           (rest < -cell_rounding::to_upper ? 1 : 0);
}
/// Coordinates of position p lie above p - reach_below and below p + reach_above units.
inline constexpr double reach_below = 132.0 / 192.0;
inline constexpr double reach_above = 62.0 / 192.0;

/// Closed box of positions; empty when lo > hi. Of points with whole coordinates, their box in
/// lattice units.
struct Box {
    std::array<std::int64_t, 3> lo{coordinate_limit, coordinate_limit, coordinate_limit};
    std::array<std::int64_t, 3> hi{-coordinate_limit, -coordinate_limit, -coordinate_limit};

    [[nodiscard]] static Box of(const LatticePoint& p) {
        Box b;
        b.add(p);
        return b;
    }
    [[nodiscard]] bool is_empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
    void add(const LatticePoint& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t at = position_of(p[static_cast<int>(k)]);
            lo[k] = std::min(lo[k], at);
            hi[k] = std::max(hi[k], at);
        }
    }
    /// \pre p.is_whole()
    void add_whole(const LatticePoint& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t at = p[static_cast<int>(k)].to_integer();
            lo[k] = std::min(lo[k], at);
            hi[k] = std::max(hi[k], at);
        }
    }
    void add(const Box& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], b.lo[k]);
            hi[k] = std::max(hi[k], b.hi[k]);
        }
    }
    [[nodiscard]] Box intersected(const Box& b) const {
        Box r;
        for (std::size_t k = 0; k < 3; ++k) {
            r.lo[k] = std::max(lo[k], b.lo[k]);
            r.hi[k] = std::min(hi[k], b.hi[k]);
        }
        return r;
    }
    [[nodiscard]] bool overlaps(const Box& b) const {
        return lo[0] <= b.hi[0] && b.lo[0] <= hi[0] && lo[1] <= b.hi[1] && b.lo[1] <= hi[1] &&
               lo[2] <= b.hi[2] && b.lo[2] <= hi[2];
    }
    friend bool operator==(const Box&, const Box&) = default;
};

/// The next position for a reference point, from one on in a direction: even, and a double.
[[nodiscard]] constexpr std::int64_t reference_position(std::int64_t from, std::int64_t direction) {
    const std::int64_t above = (from % 6 + 6) % 6;  // the multiple of six below
    return above == 0 ? from : from - above + (direction > 0 ? 6 : 0);
}
/// How far from a splitting plane of the usual offset the first reference point is tried: below and
/// above it, by its axis. Two coordinates of such points, in 1/32 units, have no integer relation
/// with coefficients below five, so that a way along the third axis passes no edge that lies along
/// or across the diagonal of a square, or of five in a row: those of height fields.
inline constexpr std::array<std::array<std::int64_t, 3>, 2> first_reference_steps{
    {{15, 27, 39}, {3, 27, 111}}};
[[nodiscard]] constexpr bool may_be_splitter(std::int64_t position) {
    return position % 2 != 0 && position % 3 != 0;
}
/// The position of a coordinate. \pre is_whole()
[[nodiscard]] constexpr std::int64_t fine_position(Coordinate c) {
    return c.to_integer() * splitting_scale;
}
/// Below and above all coordinates of a lattice position: in 1/192 units, closed. `whole`: there
/// are no fractions.
[[nodiscard]] constexpr std::int64_t fine_lower(std::int64_t position, bool whole) {
    return position * splitting_scale - (whole ? 0 : splitting_scale - usual_splitting_offset);
}
[[nodiscard]] constexpr std::int64_t fine_upper(std::int64_t position, bool whole) {
    return position * splitting_scale + (whole ? 0 : std::int64_t{usual_splitting_offset});
}
/// The last lattice plane at or below a position.
[[nodiscard]] constexpr std::int64_t lattice_below(std::int64_t position) {
    const std::int64_t q = position / splitting_scale;
    return q - (q * splitting_scale > position ? 1 : 0);
}
/// A position in lattice units, rounded: within last_place of its size.
[[nodiscard]] constexpr double rounded_position(std::int64_t position) {
    return static_cast<double>(position) / static_cast<double>(splitting_scale);
}
/// Whether rounded_position() is exact.
[[nodiscard]] constexpr bool is_double(std::int64_t position) {
    return position % 3 == 0 && position / 3 < coordinate_limit && position / 3 > -coordinate_limit;
}
/// Beyond every lattice point.
inline constexpr std::int64_t universe_limit = (coordinate_limit + 16) * splitting_scale + 1;

/// A point with coordinates in 1/192 lattice units.
struct FinePoint {
    std::array<std::int64_t, 3> c{};
    friend bool operator==(const FinePoint&, const FinePoint&) = default;
};

/// A box of the partition, bounded by splitting planes; positions in 1/192 lattice units.
struct Cell {
    std::array<std::int64_t, 3> lo{-universe_limit, -universe_limit, -universe_limit};
    std::array<std::int64_t, 3> hi{universe_limit, universe_limit, universe_limit};

    /// The lattice points in the cell, as a box (empty when there is none).
    [[nodiscard]] Box lattice_box() const {
        Box b;
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = lattice_below(lo[k]) + 1;  // splitting planes are never lattice positions
            b.hi[k] = lattice_below(hi[k]);
        }
        return b;
    }
    /// Whether a closed box of lattice points meets the cell.
    [[nodiscard]] bool meets(const Box& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (b.hi[k] <= lattice_below(lo[k]) || b.lo[k] > lattice_below(hi[k])) return false;
        return true;
    }
    [[nodiscard]] bool contains(const Box& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (b.lo[k] <= lattice_below(lo[k]) || b.hi[k] > lattice_below(hi[k])) return false;
        return true;
    }
    [[nodiscard]] bool contains(const FinePoint& p) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (p.c[k] <= lo[k] || p.c[k] >= hi[k]) return false;
        return true;
    }
    [[nodiscard]] Cell below(int axis, std::int64_t splitter) const {
        Cell c = *this;
        c.hi[static_cast<std::size_t>(axis)] = splitter;
        return c;
    }
    [[nodiscard]] Cell above(int axis, std::int64_t splitter) const {
        Cell c = *this;
        c.lo[static_cast<std::size_t>(axis)] = splitter;
        return c;
    }
};

/// Two units beyond the corner of a box, at even positions with different fractions along the axes,
/// so that segments between such points meet few edges and vertices of integer models.
[[nodiscard]] inline FinePoint point_beyond(const Box& box) {
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = (box.is_empty() ? 0 : box.lo[k] - 2) * splitting_scale +
                 static_cast<std::int64_t>(12 + 24 * k);
    return p;
}

}  // namespace trisect::detail
