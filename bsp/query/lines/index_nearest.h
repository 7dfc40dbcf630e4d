// SPDX-License-Identifier: Apache-2.0
//
// Nearest points of the boundary.
#pragma once

#include <optional>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

enum class NearestKind : std::uint8_t { Boundary, Edge, Vertex };

/// The nearest point of the boundary, or of those on an edge or vertex, or on a vertex.
[[nodiscard]] std::optional<Nearest> nearest(const IndexCore& core, const IndexPoint& point,
                                             NearestKind kind);

/// Bounds of the distance.
[[nodiscard]] std::optional<NearestBounds> distance(const IndexCore& core, const IndexPoint& point);

/// The double nearest to the square root of a number >= 0.
[[nodiscard]] double nearest_root(const ExactRational& square);

}  // namespace trisect::detail
