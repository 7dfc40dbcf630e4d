// SPDX-License-Identifier: Apache-2.0
//
// Solids of many meshes at once.
#pragma once

#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// What Solid::from_mesh makes of each mesh, in their order, and so are source_id()s of the solids.
/// Meshes are shared among the threads that `options.import.threads` allows; so many small ones
/// take the time of one thread divided by their number, but for some microseconds each. The result
/// does not depend on it. Of no mesh there is no solid; an empty mesh is the empty set.
/// \throw what from_mesh throws of the first mesh of which it throws something
[[nodiscard]] std::vector<Solid> solids_of_meshes(std::span<const PolygonMesh> meshes,
                                                  const SolidOptions& options = {});

}  // namespace trisect
