// SPDX-License-Identifier: Apache-2.0
//
// Coordinate: one coordinate of a lattice point, a double.
// It has no arithmetic: a difference of two coordinates is rounded unless something proves the
// contrary, so code that subtracts names what it wants. to_double() is the double, to_integer() the
// number for exact arithmetic.
#pragma once

#include <bit>
#include <compare>
#include <concepts>
#include <cstdint>

#include <trisect/kernel/contract.h>

namespace trisect {

/// Largest number of bits before the point: |coordinate| < 2^53.
inline constexpr int coordinate_bits = 53;
inline constexpr std::int64_t coordinate_limit = std::int64_t{1} << coordinate_bits;
/// Largest number of bits behind the point.
inline constexpr int fraction_limit = 73;

/// A double below coordinate_limit in magnitude that is a multiple of 2^-fraction_limit, in lattice
/// units. Regular value type of eight bytes, totally ordered; there is one zero.
class Coordinate {
public:
    constexpr Coordinate() = default;
    /// \pre |value| <= coordinate_limit, as bounds to compare with are
    template <std::signed_integral Integer>
    constexpr Coordinate(Integer value)  // NOLINT(google-explicit-constructor): a number
        : value_(static_cast<double>(value)) {
        const std::int64_t v = value;
        TRISECT_EXPECTS(v <= coordinate_limit && v >= -coordinate_limit, "a coordinate too large");
    }
    /// \pre a multiple of 2^-fraction_limit, |value| < coordinate_limit
    explicit constexpr Coordinate(double value) : value_(value + 0.0) {}  // -0 becomes +0

    [[nodiscard]] constexpr double to_double() const { return value_; }
    [[nodiscard]] constexpr bool is_whole() const {
        return static_cast<double>(static_cast<std::int64_t>(value_)) == value_;
    }
    /// \pre is_whole()
    [[nodiscard]] constexpr std::int64_t to_integer() const {
        return static_cast<std::int64_t>(value_);
    }
    /// Equal coordinates have equal bits: for hashing.
    [[nodiscard]] constexpr std::uint64_t bits() const {
        return std::bit_cast<std::uint64_t>(value_);
    }
    [[nodiscard]] constexpr Coordinate operator-() const { return Coordinate(-value_); }

    friend constexpr bool operator==(Coordinate a, Coordinate b) { return a.value_ == b.value_; }
    friend constexpr std::strong_ordering operator<=>(Coordinate a, Coordinate b) {
        if (a.value_ < b.value_) return std::strong_ordering::less;
        return a.value_ > b.value_ ? std::strong_ordering::greater : std::strong_ordering::equal;
    }
    friend constexpr bool operator<(Coordinate a, Coordinate b) { return a.value_ < b.value_; }
    friend constexpr bool operator>(Coordinate a, Coordinate b) { return a.value_ > b.value_; }
    friend constexpr bool operator<=(Coordinate a, Coordinate b) { return a.value_ <= b.value_; }
    friend constexpr bool operator>=(Coordinate a, Coordinate b) { return a.value_ >= b.value_; }

private:
    double value_ = 0;
};

}  // namespace trisect
