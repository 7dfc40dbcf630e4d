// SPDX-License-Identifier: Apache-2.0
//
// LatticeMove: an exact map of a lattice onto itself.
// Quarter turns, mirrors and a translation by whole units.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/bsp/cells/cell.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

/// x -> P x + t with a signed permutation P and integers t. What is below a plane is below the
/// plane's image, also under a mirror. Trivial type.
struct LatticeMove {
    std::array<std::uint8_t, 3> from{0, 1, 2};  ///< coordinate i of the image is this coordinate
    std::array<std::int8_t, 3> sign{1, 1, 1};   ///< times this
    std::array<std::int64_t, 3> by{};           ///< plus this, |by| < 2^55

    [[nodiscard]] bool is_mirror() const;
    /// The axis that an axis is mapped to.
    [[nodiscard]] int image_of_axis(int axis) const;
    /// Whether the image of an axis points the other way.
    [[nodiscard]] bool turns_over(int image_axis) const {
        return sign[static_cast<std::size_t>(image_axis)] < 0;
    }

    /// \throw LimitError beyond the range of the lattice, or where the sum is no double.
    [[nodiscard]] LatticePoint applied(const LatticePoint& p) const;
    [[nodiscard]] Box applied(const Box& box) const;
    /// Of a splitter across an axis: its position across image_of_axis(axis).
    [[nodiscard]] std::int64_t applied_to_wall(int axis, std::int64_t position) const;
    [[nodiscard]] FinePoint applied(const FinePoint& p) const;
    [[nodiscard]] Plane applied(const Plane& plane) const;
    [[nodiscard]] Approximation applied(const Approximation& p) const;
};

}  // namespace trisect::detail
