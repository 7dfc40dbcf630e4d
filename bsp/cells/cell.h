// SPDX-License-Identifier: Apache-2.0
//
// Boxes and cells of the partition.
//
// A splitting plane lies at an odd multiple of 1/256 of the lattice unit, so no lattice point lies
// on one, and a closed box of lattice points is on one side of a splitting plane or truly crosses
// it. That makes closed cells as good as half-open ones: nothing is listed twice because it ends at
// a splitting plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// The position of a coordinate among lattice planes.
[[nodiscard]] constexpr std::int64_t position_of(Coordinate c) { return c.to_integer(); }

/// Closed box in lattice units; empty when lo > hi.
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

/// Positions of splitting planes and reference points count in 1/256 of the lattice unit.
inline constexpr int splitting_bits = 8;
inline constexpr std::int64_t splitting_scale = std::int64_t{1} << splitting_bits;
/// Of a coordinate, in the same units.
[[nodiscard]] constexpr std::int64_t fine_position(Coordinate c) {
    return c.to_integer() * splitting_scale;
}
/// Beyond every lattice point.
inline constexpr std::int64_t universe_limit = (coordinate_limit + 16) * splitting_scale + 1;

/// A point with coordinates in 1/256 lattice units.
struct FinePoint {
    std::array<std::int64_t, 3> c{};
    friend bool operator==(const FinePoint&, const FinePoint&) = default;
};

/// A box of the partition, bounded by splitting planes; positions in 1/256 lattice units.
struct Cell {
    std::array<std::int64_t, 3> lo{-universe_limit, -universe_limit, -universe_limit};
    std::array<std::int64_t, 3> hi{universe_limit, universe_limit, universe_limit};

    /// The lattice points in the cell, as a box (empty when there is none).
    [[nodiscard]] Box lattice_box() const {
        Box b;
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] =
                (lo[k] >> splitting_bits) + 1;  // splitting planes are never lattice positions
            b.hi[k] = hi[k] >> splitting_bits;
        }
        return b;
    }
    /// Whether a closed box of lattice points meets the cell.
    [[nodiscard]] bool meets(const Box& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (b.hi[k] <= (lo[k] >> splitting_bits) || b.lo[k] > (hi[k] >> splitting_bits))
                return false;
        return true;
    }
    [[nodiscard]] bool contains(const Box& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (b.lo[k] <= (lo[k] >> splitting_bits) || b.hi[k] > (hi[k] >> splitting_bits))
                return false;
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
                 static_cast<std::int64_t>(12 + 22 * k);
    return p;
}

}  // namespace trisect::detail
