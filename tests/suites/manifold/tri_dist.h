// SPDX-License-Identifier: Apache-2.0
//
// Stand-in for a private header of Manifold's that its tests include.
#pragma once

#include <array>

#include <manifold/manifold.h>

namespace manifold {

// NOLINTNEXTLINE(readability-identifier-naming): theirs
inline double DistanceTriangleTriangleSquared(const std::array<vec3, 3>& /*a*/,
                                              const std::array<vec3, 3>& /*b*/) {
    throw NotSupported("private functions");
}

}  // namespace manifold
