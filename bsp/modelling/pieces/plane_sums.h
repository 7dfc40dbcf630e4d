// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of outlines, by convolution.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Directed sides between corners.
struct SumSides {
    std::vector<Point2d> corners;
    std::vector<std::array<std::uint32_t, 2>> sides;
};

/// Adds sides that go around each point as often as the one set, and the other turned about the
/// origin and moved there, have common parts. Sums of corners are rounded once. O(n m), and as many
/// sides at most; n + m of convex outlines.
/// \pre both run counter-clockwise around sets without holes and do not cross themselves
void add_convolution(SumSides& out, const Outline& a, const Outline& b);

}  // namespace trisect::detail
