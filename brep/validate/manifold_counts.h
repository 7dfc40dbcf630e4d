// SPDX-License-Identifier: Apache-2.0
//
// Counts of a triangle mesh that is a closed 2-manifold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace trisect {

struct ManifoldCounts {
    std::size_t vertices = 0;  ///< those of triangles
    std::size_t edges = 0;
    std::size_t shells = 0;    ///< connected by edges
    std::ptrdiff_t genus = 0;  ///< handles, summed over the shells
    friend bool operator==(const ManifoldCounts&, const ManifoldCounts&) = default;
};

/// Nothing unless, by the names of corners, every edge belongs to two triangles that pass it in
/// opposite directions and the triangles around every corner form one fan. A boundary that touches
/// itself is no manifold: counts of its Brep keep copies of a vertex separate. O(n).
/// \pre corners are below point_count; fewer than 2^30 triangles
[[nodiscard]] std::optional<ManifoldCounts> manifold_counts(
    std::size_t point_count, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace trisect
