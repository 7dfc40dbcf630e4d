// SPDX-License-Identifier: Apache-2.0
//
// TurnedBox: an oriented box around triangles, in conservatively rounded doubles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// What boxes of one figure are computed with: an origin, so that numbers are small, and a margin
/// larger than all their errors together.
struct BoxFrame {
    LatticePoint origin;
    double margin = 0;

    /// For points between two corners.
    BoxFrame() = default;
    BoxFrame(const LatticePoint& low, const LatticePoint& high);
};

/// The points whose coordinates along three nearly orthonormal axes are between `low` and `high`.
struct TurnedBox {
    using Vector = std::array<double, 3>;

    std::array<Vector, 3> axis{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
    Vector low{}, high{};

    /// Along the axes.
    TurnedBox(const BoxFrame& frame, const LatticePoint& low_corner,
              const LatticePoint& high_corner);

    /// Turned with the triangles `order`: along their normals where these agree, and along their
    /// longest edge. Nothing when they suggest no directions. O(n).
    [[nodiscard]] static std::optional<TurnedBox> around(
        const BoxFrame& frame, std::span<const LatticePoint> points,
        std::span<const std::array<std::uint32_t, 3>> triangles,
        std::span<const std::uint32_t> order);

    /// True only if the boxes, as exact sets, are disjoint: an axis of one of them separates them,
    /// or the one across their longest axes.
    [[nodiscard]] bool is_apart(const TurnedBox& other, const BoxFrame& frame) const;

private:
    TurnedBox() = default;
    [[nodiscard]] bool is_apart_across(const TurnedBox& other, double margin) const;
    [[nodiscard]] const Vector& longest_axis() const;
};

}  // namespace trisect::detail
