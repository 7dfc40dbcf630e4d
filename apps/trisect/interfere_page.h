// SPDX-License-Identifier: Apache-2.0
//
// Page of two placed solids and what they have in common.
#pragma once

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>

#include <array>
#include <optional>
#include <string>

#include "page_scene.h"

namespace trisect::app {

struct PlacedBody {
    std::string name;
    InterferenceModel model;
    PosePlace pose = identity_pose;
};

/// \param result with contacts and regions
[[nodiscard]] std::string interfere_page(const std::array<PlacedBody, 2>& bodies,
                                         const InterferenceResult& result,
                                         const std::optional<BoundaryDistance>& distance);

/// Both solids as bodies 0 and 1 of a scene.
[[nodiscard]] PageScene scene_of(const std::array<PlacedBody, 2>& bodies);

}  // namespace trisect::app
