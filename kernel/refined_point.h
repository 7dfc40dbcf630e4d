// SPDX-License-Identifier: Apache-2.0
//
// RefinedPoint: the common point of three planes to some hundred bits.
#pragma once

#include <array>
#include <optional>

#include <trisect/kernel/predicates.h>

namespace trisect {

/// Coordinates in lattice units as sums of two doubles.
struct RefinedPoint {
    std::array<double, 3> high{};
    std::array<double, 3> low{};  ///< at most half a unit in the last place of `high`
    double error = 0;             ///< no coordinate is off by more
};

/// What nearest_doubles() makes before it rounds: one step of iterative refinement, whose error is
/// some 2^-95 of the largest coordinate where the planes are not nearly parallel. Nothing where
/// doubles bound nothing.
[[nodiscard]] std::optional<RefinedPoint> refined_point(const Approximation& approximation,
                                                        const Plane& p, const Plane& q,
                                                        const Plane& r);
[[nodiscard]] std::optional<RefinedPoint> refined_point(const Approximation& approximation,
                                                        const std::array<CornerPlane, 3>& planes);

}  // namespace trisect
