// SPDX-License-Identifier: Apache-2.0
//
// Prisms for the tests of the multidimensional partition.
#pragma once

#include "support/breps.h"

namespace trisect::test {

/// Four spikes, with a reflex corner between each two.
inline Brep prism_over_a_star() {
    return prism({{{0, 0, 0},
                   {6, 2, 0},
                   {12, 0, 0},
                   {10, 6, 0},
                   {12, 12, 0},
                   {6, 10, 0},
                   {0, 12, 0},
                   {2, 6, 0}}},
                 5);
}

/// A square with straight corners in two of its sides.
inline Brep prism_with_straight_corners() {
    return prism({{{0, 0, 0}, {3, 0, 0}, {6, 0, 0}, {6, 6, 0}, {3, 6, 0}, {0, 6, 0}}}, 5);
}

}  // namespace trisect::test
