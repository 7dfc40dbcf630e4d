// SPDX-License-Identifier: Apache-2.0
//
// Pairs of moving solids for tests of certificates.
#pragma once

#include <cstdint>

#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "motion_oracle.h"
#include "reference/random_solids.h"

namespace moving {

struct Pair {
    trisect::InterferenceModel a;
    trisect::Motion motion_a;
    trisect::InterferenceModel b;
    trisect::Motion motion_b;
};

inline trisect::Motion by(double x, double y, double z) {
    return trisect::Motion::translation(trisect::Pose(), {x, y, z});
}

inline std::int64_t small(reference::Random& random) { return random.between(-2, 2); }

/// Solids of a small grid; B comes from far outside, mostly on a rational screw, and passes by.
inline Pair random_pair(std::uint64_t seed) {
    reference::Random random(seed);
    const auto solid = [&random] {
        return trisect::InterferenceModel(engines::solid(reference::random_embedded_solid(random)));
    };
    Pair c{solid(), trisect::Motion(), solid(), trisect::Motion()};
    oracle::Placement p;
    if (random.chance(1, 2))
        p.quaternion = {random.between(1, 3), small(random), small(random), small(random)};
    if (random.chance(2, 3))
        p.screw.turn = {random.between(3, 9), small(random), small(random), small(random)};
    for (std::size_t i = 0; i < 3; ++i) {
        p.screw.center[i] = static_cast<double>(random.between(0, 8));
        p.screw.shift[i] = static_cast<double>(random.between(-4, 4));
        p.at[i] = static_cast<double>(random.between(-5, 5));
    }
    const std::size_t axis = random.below(3);
    const double side = random.chance(1, 2) ? 1 : -1;
    p.at[axis] = side * static_cast<double>(random.between(14, 22));
    p.screw.shift[axis] -= side * static_cast<double>(random.between(10, 30));
    c.motion_b = p.motion();
    return c;
}

}  // namespace moving
