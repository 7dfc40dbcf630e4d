// SPDX-License-Identifier: Apache-2.0
//
// Radial order: pairing of the faces around an edge into solid wedges.
// It is needed at edges of four or more faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect {

/// A direction given by the sign (-1 or 1) of one of its components; enough to distinguish the two
/// directions of a line apart.
struct AxisDirection {
    int axis = 0;
    int sign = 1;
};

/// The direction from one point to another. \pre from != to.
[[nodiscard]] AxisDirection direction_between(const Point& from, const Point& to);

/// A face seen from one of its edges.
struct RadialFace {
    const Plane* plane = nullptr;  ///< outward
    bool along = true;             ///< its loop runs along the reference direction of the edge
};

/// Pairs the faces around an edge across the solid's wedges: result[i] is the partner of face i,
/// always one of the other sense.
///
/// Exact, from the signs of cross and dot products of the planes' normals alone. Faces in the same
/// half-plane (a solid touching itself along a face) are ordered so that the material on both sides
/// stays apart. Where the winding number exceeds 1 the wedges nest like parentheses.
/// O(n log n). \pre every plane contains the edge; as many faces run along the direction as
/// against.
[[nodiscard]] std::vector<std::uint32_t> pair_across_inside(std::span<const RadialFace> faces,
                                                            AxisDirection direction);

}  // namespace trisect
