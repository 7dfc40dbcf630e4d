// SPDX-License-Identifier: Apache-2.0
//
// Test of planar directed segments as the outline of a region.
// The region must lie to the left of each segment.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Ends of a segment, by name.
struct OutlineEdge {
    std::uint32_t from, to;
};

/// The coordinates that remain in the projection.
struct FlatAxes {
    int u, v;
};

/// True if segments meet in common named ends only, ends of different names are at different
/// places, and the winding number of all segments together is 0 or 1 everywhere. The segments may
/// form any number of loops. One sweep, O(n log n), exact.
/// \pre at every end as many segments come as go.
[[nodiscard]] bool is_region_outline(std::span<const LatticePoint> points, FlatAxes axes,
                                     std::span<const OutlineEdge> edges);

}  // namespace trisect::detail
