// SPDX-License-Identifier: Apache-2.0
//
// Point3d: three coordinates as doubles.
#pragma once

#include <array>

namespace trisect {

/// A point or a vector. In the user's units, unless it is said to be in lattice units.
using Point3d = std::array<double, 3>;

}  // namespace trisect
