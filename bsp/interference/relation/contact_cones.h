// SPDX-License-Identifier: Apache-2.0
//
// ContactCones: the local relation of two boundaries at a common point.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// A triangle of a boundary that contains the point, and which of its features the point is on.
struct ConePart {
    PosedTriangle triangle;
    std::array<std::uint32_t, 3> place{};  ///< equal numbers: corners at the same place
    Feature at;
};

/// Which flags the neighbourhood of the point sets: exact, from signs of directions alone.
///
/// `a` and `b` are all triangles of the boundaries that contain the point, each once. `thorough`
/// must be set where a boundary touches itself at the point in more than copies of one vertex or
/// edge. Cost: a sign for every face of one and every direction of the other; some microseconds.
[[nodiscard]] BoundaryFlags compare_cones(std::span<const ConePart> a, std::span<const ConePart> b,
                                          const PosedPair& poses, bool thorough);

}  // namespace trisect::detail
