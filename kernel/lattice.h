// SPDX-License-Identifier: Apache-2.0
//
// Lattice: the unit, a power of two, of solids' corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The unit is 2^exponent. The exponent is a multiple of 8 except where choose_lattice() needs
/// another one to keep fractions. Value type.
struct Lattice {
    int exponent = 0;

    /// The coordinate in the user's units, rounded once (exact unless it underflows).
    [[nodiscard]] double to_double(double lattice_units) const;
    friend constexpr auto operator<=>(const Lattice&, const Lattice&) = default;
};

/// What becomes of bits behind the point.
enum class Fractions : std::uint8_t {
    Rounded,  ///< coordinates are whole
    Kept      ///< coordinates have up to fraction_limit bits behind the point
};

/// What import to a lattice changed. Nothing is rounded in silence.
struct LatticeReport {
    Lattice lattice;
    bool lossless = true;
    std::size_t moved = 0;          ///< points with a rounded coordinate
    double max_move = 0;            ///< largest change of one coordinate, user's units
    std::size_t flipped_faces = 0;  ///< faces that were turned over or became flat by rounding
};

/// Bits left free above the largest coordinate when the lattice is chosen automatically.
inline constexpr int growth_bits = 8;

/// The coarsest lattice, its exponent a multiple of 8, on which all coordinates are whole and
/// growth_bits are free. Where there is none:
/// - Rounded: the finest that leaves them free.
/// - Kept: that one, if no coordinate then has more than fraction_limit bits behind the point.
///   Otherwise the coarsest one where none has more and all are below 2^53, with a multiple of 8
///   where possible; these are all sets that span at most 126 bits. For others the finest one with
///   coordinates below 2^53.
/// Non-finite values are the caller's error. O(n). An empty or all-zero set gets exponent 0.
/// `threads`: how many may take part, 0 means one for every processor; the outcome does not depend
/// on it.
[[nodiscard]] Lattice choose_lattice(std::span<const Point3d> points, std::uint32_t threads = 0,
                                     Fractions fractions = Fractions::Rounded);

/// The bits from the leading one of the largest coordinate to the last one of any: the least W for
/// which all coordinates are whole numbers below 2^W of one power of two. 0 where all are 0.
/// Coordinates that are not finite do not count. O(n).
[[nodiscard]] int span_bits(std::span<const Point3d> points);

/// Rounds to the nearest whole coordinates, or with Kept to the nearest multiples of 2^-73 units,
/// and reports; ties to even. On its own lattice (choose_lattice) a set that spans at most 126 bits
/// keeps every double with Kept. Minus zero becomes plus zero, which is no move.
/// \throw LimitError when a coordinate is not finite or leaves the lattice's range; Error
/// (InvalidSolid) when it is rounded beyond the largest double, which Kept never does.
[[nodiscard]] std::vector<LatticePoint> to_lattice(std::span<const Point3d> points, Lattice lattice,
                                                   LatticeReport& report, std::uint32_t threads = 0,
                                                   Fractions fractions = Fractions::Rounded);

}  // namespace trisect
