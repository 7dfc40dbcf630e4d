// SPDX-License-Identifier: Apache-2.0
//
// Small solids and poses under which they meet, touch and coincide.
#pragma once

#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

#include "reference/random_solids.h"

namespace scene_test {

/// A cube, or any embedded solid of the reference engine.
[[nodiscard]] trisect::InterferenceModel random_model(reference::Random& random);

/// Moves by small integers, mostly turned by a quarter or by an angle with cosine 3/5; now and then
/// mirrored.
[[nodiscard]] trisect::Pose random_pose(reference::Random& random);

}  // namespace scene_test
