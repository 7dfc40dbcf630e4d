// SPDX-License-Identifier: Apache-2.0
//
// Page of two solids with the volumes of structures around them.
#pragma once

#include <trisect/kernel/pose.h>

#include <span>
#include <string>

#include "../scenes/comparison.h"
#include "interfere_page.h"

namespace trisect::app {

/// Volumes of the first levels at some of the frames, and what each of these costs. Solids are
/// compared anew, which counts and takes no times.
[[nodiscard]] std::string hierarchies_page(const std::array<PlacedBody, 2>& bodies,
                                           std::span<const Pose> poses,
                                           std::span<const PosePlace> places,
                                           const scenes::Comparison& comparison);

}  // namespace trisect::app
