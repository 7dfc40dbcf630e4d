// SPDX-License-Identifier: Apache-2.0
//
// Point2d: a corner of an outline in the plane z = 0.
// Coordinates are in the user's units.
#pragma once

#include <array>
#include <vector>

namespace trisect {

using Point2d = std::array<double, 2>;

/// A closed polygon without a repeated last corner. Either orientation.
using Outline = std::vector<Point2d>;

}  // namespace trisect
