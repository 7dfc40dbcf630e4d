// SPDX-License-Identifier: Apache-2.0
//
// Integers for axis-perpendicular polygons.
//
// Coordinates with bits behind the point are integers of a finer unit. Arithmetic of twice the
// width is some times slower, so whole coordinates keep their own.
#pragma once

#include <cmath>
#include <cstdint>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// Positions in 1/192 lattice units are others of so many bits less.
inline constexpr int wide_axis_bits = 64;

/// Of one type of integers. A *place* is a coordinate. A *position* counts in units finer by
/// `scale`, in which splitting planes and reference points have integers, too.
template <class Number>
struct AxisNumbers;

/// Whole coordinates: places in lattice units, positions in 1/192 of them. Places are below 2^53,
/// positions below 2^61, their sums below 2^62; steps between places have 54 bits, so their product
/// with a position fits into 128.
template <>
struct AxisNumbers<std::int64_t> {
    using Product = Int128;
    static constexpr bool whole = true;
    static constexpr std::int64_t scale = splitting_scale;

    [[nodiscard]] static bool takes(const Source& source) {
        return !source.is_half_space() && source.is_whole();
    }
    [[nodiscard]] static bool takes(const LatticePoint& p) { return p.is_whole(); }
    [[nodiscard]] static bool takes(Coordinate c) { return c.is_whole(); }
    [[nodiscard]] static std::int64_t place(Coordinate c) { return c.to_integer(); }
    /// From 1/192 lattice units.
    [[nodiscard]] static std::int64_t from_fine(std::int64_t position) { return position; }
    /// From and to the wide numbers below.
    [[nodiscard]] static std::int64_t from_wide(Int128 position) {
        return static_cast<std::int64_t>(position >> wide_axis_bits);
    }
    [[nodiscard]] static Int128 to_wide(std::int64_t position) {
        return Int128{position} * (Int128{1} << wide_axis_bits);
    }
    [[nodiscard]] static double to_double(std::int64_t place) { return static_cast<double>(place); }
    /// Any place near a double.
    [[nodiscard]] static std::int64_t place_near(double c) {
        return static_cast<std::int64_t>(std::floor(c));
    }
    /// \pre is_place(position)
    [[nodiscard]] static std::int64_t place_of(std::int64_t position) { return position / scale; }
    [[nodiscard]] static bool is_place(std::int64_t position) { return position % scale == 0; }
    [[nodiscard]] static Product multiply(Int128 a, Int128 b) { return a * b; }
};

/// Coordinates with up to 70 bits behind the point: places in units of 2^-70, positions in thirds
/// of that. Places are below 2^123, positions below 2^125, their sums below 2^126.
template <>
struct AxisNumbers<Int128> {
    using Product = WideInt<4>;
    static constexpr bool whole = false;
    static constexpr std::int64_t scale = 3;
    static constexpr int most_bits = 70;
    static_assert(Int128{splitting_scale} << wide_axis_bits == Int128{scale} << most_bits);

    [[nodiscard]] static bool takes(const Source& source) {
        return !source.is_half_space() && source.fraction_bits() <= most_bits;
    }
    [[nodiscard]] static bool takes(const LatticePoint& p) { return fraction_bits(p) <= most_bits; }
    [[nodiscard]] static bool takes(Coordinate c) { return fraction_bits(c) <= most_bits; }
    [[nodiscard]] static Int128 place(Coordinate c) { return scaled_integer(c, most_bits); }
    [[nodiscard]] static Int128 from_fine(std::int64_t position) {
        return AxisNumbers<std::int64_t>::to_wide(position);
    }
    [[nodiscard]] static Int128 from_wide(Int128 position) { return position; }
    [[nodiscard]] static Int128 to_wide(Int128 position) { return position; }
    /// Exact for coordinates.
    [[nodiscard]] static double to_double(Int128 place) {
        return static_cast<double>(place) * 0x1p-70;
    }
    [[nodiscard]] static Int128 place_near(double c) { return static_cast<Int128>(c * 0x1p70); }
    /// \pre is_place(position). Exact division is a product modulo 2^128 with the inverse.
    [[nodiscard]] static Int128 place_of(Int128 position) {
        constexpr Uint128 third = ~Uint128{0} / 3 * 2 + 1;
        static_assert(third * 3 == 1);
        return static_cast<Int128>(static_cast<Uint128>(position) * third);
    }
    /// 2^64 is 1 modulo 3.
    [[nodiscard]] static bool is_place(Int128 position) {
        const auto low = static_cast<std::uint64_t>(position);
        const auto high = static_cast<std::int64_t>(position >> 64);
        return (static_cast<std::int64_t>(low % 3) + high % 3) % 3 == 0;
    }
    [[nodiscard]] static Product multiply(Int128 a, Int128 b) {
        return trisect::multiply<4>(WideInt<2>(a), WideInt<2>(b));
    }
};

/// Of a coordinate.
template <class Number>
[[nodiscard]] Number axis_position(Coordinate c) {
    using Numbers = AxisNumbers<Number>;
    return Numbers::place(c) * Numbers::scale;
}

/// A position of a coordinate or a splitting plane as a double, in lattice units. Coordinates are
/// exact.
[[nodiscard]] inline double rounded_axis_position(std::int64_t position) {
    return rounded_position(position);
}
[[nodiscard]] inline double rounded_axis_position(Int128 position) {
    using Numbers = AxisNumbers<Int128>;
    return Numbers::is_place(position)
               ? Numbers::to_double(Numbers::place_of(position))
               : rounded_position(static_cast<std::int64_t>(position >> wide_axis_bits));
}

}  // namespace trisect::detail
