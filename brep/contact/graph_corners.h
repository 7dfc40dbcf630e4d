// SPDX-License-Identifier: Apache-2.0
//
// Corners whose triangles are a graph over a plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// By point: 1 where doubles show that the triangles around it go once around a direction, from
/// which all of them are seen. Then two of them have nothing in common but the corners and edges
/// that they share by name. 0 elsewhere, and of points that are corners of no
/// triangle of `wanted`.
/// \pre the triangles around each point are one closed fan, as Twins has them. O(n)
[[nodiscard]] std::vector<std::uint8_t> find_graph_corners(
    std::span<const LatticePoint> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::array<std::uint32_t, 3>> wanted);

}  // namespace trisect::detail
