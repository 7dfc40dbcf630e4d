// SPDX-License-Identifier: Apache-2.0
//
// Pairs of placed solids for tests of certificates.
#pragma once

#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

#include "interference_oracle.h"

namespace brute {

struct PlacedPair {
    trisect::InterferenceModel a;
    trisect::InterferenceModel b;
    trisect::Pose pose_a;
    trisect::Pose pose_b;
};

/// Models of a random scene.
inline PlacedPair placed_pair(reference::Random& random) {
    const Scene scene = random_scene(random);
    return {trisect::InterferenceModel(scene.a.solid()),
            trisect::InterferenceModel(scene.b.solid()), scene.pose_a, scene.pose_b};
}

}  // namespace brute
