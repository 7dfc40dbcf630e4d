// SPDX-License-Identifier: Apache-2.0
//
// Argument checks and lattice-friendly points on circles for the primitives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Most segments of a circle.
inline constexpr std::uint32_t segment_limit = 1U << 16;

/// \throw UsageError "<name> must be ..." unless the value is finite and positive.
void require_positive(double value, const std::string& name);
/// \throw UsageError unless low <= value <= high.
void require_between(std::uint32_t value, std::uint32_t low, std::uint32_t high,
                     const std::string& name);

/// The coordinate rounded to a multiple of 2^-32 of the power of two above `extent`, so that a
/// lattice holds it without loss. Moves it by less than 1.2e-10 of the extent.
[[nodiscard]] double snap(double coordinate, double extent);

/// `segments` points on a circle about the origin, counter-clockwise from (radius, 0), rounded as
/// by snap(·, extent). If the number is divisible by 4, a quarter turn maps them exactly onto
/// themselves.
[[nodiscard]] std::vector<Point2d> circle(double radius, std::uint32_t segments, double extent);

}  // namespace trisect::detail
