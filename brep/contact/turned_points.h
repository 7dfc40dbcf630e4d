// SPDX-License-Identifier: Apache-2.0
//
// Points seen along the axes of a turned box-like part.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Coordinates along three directions across which most triangles lie. Boxes along them are those
/// of the part before it was turned: flat ones around flat faces, where boxes along the axes of
/// space overlap many others.
struct TurnedPoints {
    std::vector<LatticePoint> points;
    /// Each coordinate is nearer than this to that of the exact image under one linear map, so
    /// triangles that meet have boxes nearer to each other than twice this.
    double error = 0;

    /// Nothing where half of the triangles do not lie across three orthogonal directions, and
    /// where these are the axes. O(n)
    [[nodiscard]] static std::optional<TurnedPoints> of(
        std::span<const LatticePoint> points,
        std::span<const std::array<std::uint32_t, 3>> triangles);

    /// Whether the line of an edge plainly keeps two triangles apart, seen along one of the
    /// directions. Only a yes means something.
    [[nodiscard]] bool are_apart(const std::array<std::uint32_t, 3>& a,
                                 const std::array<std::uint32_t, 3>& b) const;
};

}  // namespace trisect::detail
