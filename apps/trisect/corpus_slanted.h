// SPDX-License-Identifier: Apache-2.0
//
// Scenes of the corpus with slanted faces.
// They are terrain of slanted facets, and prisms over polygons of many corners. Their volumes are
// counted with integers, their areas are sums of square roots of integers, and again no geometry
// kernel takes part.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "box_scene.h"

namespace trisect::app {

/// A scene with what is expected of it.
struct SlantedScene {
    std::string name;
    BooleanOperation operation = BooleanOperation::Union;
    std::vector<PolygonMesh> operands;
    CountedResult expected;
};

[[nodiscard]] std::vector<std::string> slanted_family_names();
/// \pre one of these names. `points` samples are picked by the seed.
[[nodiscard]] std::vector<SlantedScene> slanted_family(const std::string& name, std::size_t points,
                                                       std::uint64_t seed);

}  // namespace trisect::app
