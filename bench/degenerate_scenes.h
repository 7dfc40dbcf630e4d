// SPDX-License-Identifier: Apache-2.0
//
// Pairs of meshes that coincide somewhere, for scenes.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <trisect/brep/polygon_mesh.h>

namespace bench {

/// The operands of the scenes g:NAME, some 80,000 triangles each (scene.h); nothing for another
/// name.
[[nodiscard]] std::optional<std::pair<trisect::PolygonMesh, trisect::PolygonMesh>> degenerate_pair(
    const std::string& name);

}  // namespace bench
