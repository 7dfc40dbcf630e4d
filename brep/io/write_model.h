// SPDX-License-Identifier: Apache-2.0
//
// Model writers: 3MF, GLB, AMF and STEP.
// All else that write_mesh writes has no names and materials.
//
// 3MF, AMF and STEP have decimal text: every coordinate comes back bit for bit. GLB has floats,
// like binary STL. GLB lists the faces of a part by their materials, and says by EXT_mesh_manifold
// that they are one mesh, where each edge has two faces.
//
// STEP has planar faces of any number of corners, with holes: bridges (brep/joined_loops.h) are
// taken out. Closed shells are B-reps, with their voids; open ones are surface models. Materials
// are colours of faces, which our reader passes over. The file states an uncertainty of 10^-12 of
// the largest coordinate, rounded up to a power of ten; a polygon whose corners are off their plane
// by more is refused.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/write_mesh.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace trisect {

/// Errors: as format_mesh, and UsageError for a model that breaks its invariants; UnsupportedError
/// for a unit that the format does not have, and in STEP for faces that are not planar, have no
/// area, or an edge without length.
[[nodiscard]] FormattedMesh format_model(const Model& model, const WriteOptions& options,
                                         const std::string& name = "model");

/// Faces of more than three corners that format_model refuses to write as STEP because they are not
/// planar, by part.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> faces_off_planes(const Model& model);

/// Whether textures and properties of corners can be written (WriteOptions::properties): OBJ, PLY,
/// GLB and 3MF.
[[nodiscard]] bool holds_properties(MeshFormat format) noexcept;

/// Drops the bytes of pictures that lie in this folder under their names, so that OBJ and PLY refer
/// to them and do not bring copies.
void refer_to_pictures_in(Model& model, const std::filesystem::path& folder);

/// Writes a file as write_mesh does, after those beside it (FormattedMesh::files). OBJ and PLY
/// refer to pictures that are there.
WriteReport write_model(const std::filesystem::path& path, const Model& model,
                        const WriteOptions& options = {});

}  // namespace trisect
