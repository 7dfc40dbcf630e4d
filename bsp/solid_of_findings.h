// SPDX-License-Identifier: Apache-2.0
//
// Solids of meshes by steps that Solid takes together.
#pragma once

#include <cstdint>

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The solid that Solid::from_lattice_mesh makes under Embedding::Check; what that looks for is
/// given. So it can be found for many meshes at once, while solids get their numbers in order.
/// \pre the mesh is closed and oriented, corner by corner; `findings` are its own.
[[nodiscard]] Solid solid_of_findings(LatticeMesh mesh, EmbeddingFindings findings);
/// Solid::from_import(); `serial` is that of its source, of detail::Source::take_serials(). So many
/// can be made at once, with numbers in an order. Takes none where there is no boundary.
[[nodiscard]] Solid solid_of_import(ImportedMesh imported, Embedding embedding,
                                    InsideOut inside_out, std::uint64_t serial);

}  // namespace trisect
