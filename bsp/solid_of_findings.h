// SPDX-License-Identifier: Apache-2.0
//
// Solids of meshes whose embedding has been looked at.
#pragma once

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The solid that Solid::from_lattice_mesh makes under Embedding::Check; what that looks for is
/// given. So it can be found for many meshes at once, while solids get their numbers in order.
/// \pre the mesh is closed and oriented, corner by corner; `findings` are its own.
[[nodiscard]] Solid solid_of_findings(LatticeMesh mesh, EmbeddingFindings findings);

}  // namespace trisect
