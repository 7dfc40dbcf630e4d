// SPDX-License-Identifier: Apache-2.0
//
// Boundary points in the world, and their names.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// The point of a triangle with these weights of its corners, in the solid's lattice.
[[nodiscard]] std::array<double, 3> point_on(const SolidBoundary& s, std::uint32_t triangle,
                                             const std::array<double, 3>& weights);

/// Up to rounding.
[[nodiscard]] Point3d in_world(std::array<double, 3> p, Lattice lattice, const Pose& pose);

/// The entity that is nearest to a closest point, as far as doubles say: what contains it up to the
/// errors of the search.
[[nodiscard]] EntityName name_near(const SolidBoundary& s, std::uint32_t triangle,
                                   const std::array<double, 3>& at);

}  // namespace trisect::detail
