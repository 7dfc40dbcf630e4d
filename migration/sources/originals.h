// SPDX-License-Identifier: Apache-2.0
//
// Meshes that become originals.
#pragma once

#include <manifold/manifold.h>

#include "tri_mesh.h"

namespace manifold {

/// One run with a new number, and flat faces.
[[nodiscard]] Manifold new_original(TriMesh mesh);

}  // namespace manifold
