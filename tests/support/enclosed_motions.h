// SPDX-License-Identifier: Apache-2.0
//
// Enclosed motions of tests, and whole numbers for random ones.
#pragma once

#include <array>
#include <vector>

#include <trisect/bsp/interference/enclosed_motion.h>

#include "reference/random_solids.h"

namespace moving {

/// From one place to the other, without a turn, in a unit of time.
inline trisect::EnclosedMotion straight(std::array<double, 3> from, std::array<double, 3> to) {
    return trisect::EnclosedMotion::through(
        std::vector<trisect::KeyFrame>{{0, {1, 0, 0, 0}, from}, {1, {1, 0, 0, 0}, to}});
}

inline double whole(reference::Random& random, int low, int high) {
    return static_cast<double>(random.between(low, high));
}

}  // namespace moving
