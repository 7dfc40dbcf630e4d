// SPDX-License-Identifier: Apache-2.0
//
// Model writers: 3MF and GLB; and all that write_mesh writes, without names and materials.
//
// 3MF has decimal text: every coordinate comes back bit for bit. GLB has floats, like binary STL.
// GLB lists the faces of a part by their materials, and says by EXT_mesh_manifold that they are one
// mesh, where each edge has two faces.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/write_mesh.h>

#include <filesystem>
#include <string>

namespace trisect {

/// Errors: as format_mesh, and UsageError for a model that breaks its invariants.
[[nodiscard]] FormattedMesh format_model(const Model& model, const WriteOptions& options,
                                         const std::string& name = "model");

/// Writes a file as write_mesh does.
WriteReport write_model(const std::filesystem::path& path, const Model& model,
                        const WriteOptions& options = {});

}  // namespace trisect
