// SPDX-License-Identifier: Apache-2.0
//
// Model readers: 3MF, GLB, AMF, STEP and DXF.
// All else that read_mesh reads is one part.
//
// Of STEP, B-reps and models of shells with planar faces and straight edges are read, each a part,
// where the assemblies of the file put them. A face is one polygon; holes are joined to its outline
// by bridges (brep/joined_loops.h). Of DXF, 3DFACE, meshes, and blocks of them are read. What is
// curved is refused by its name.
//
// Components, instances and nodes are carried out: each build item, constellation, object outside
// of them, or node with a mesh is a part, its placed meshes in one. Maps are multiplied as
// fractions and each coordinate is rounded once; the report says how many changed by that. A mirror
// turns faces over. One that makes space flat is refused.
//
// What is ignored: lights, cameras, animations, slices, metadata other than names; unless asked for
// (ReadOptions::properties) textures, normals and vertex colours. What would change the shape and
// is not understood is refused by its name: extensions that the file says it requires, skins,
// morphs, compressed and external buffers, curved triangles.
//
// The same formats are read by read_mesh, which returns merged(model).
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/read_mesh.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trisect {

/// What carrying out transforms changed.
struct ModelReport {
    std::size_t rounded_vertices = 0;
    double largest_move = 0;  ///< of one coordinate, in the file's unit
    /// STEP: corners farther from the plane stated for their face than the file's uncertainty.
    std::size_t off_plane_corners = 0;
    double largest_plane_distance = 0;  ///< of any corner, in the file's unit
    /// What was asked for by ReadOptions::properties and is not there: files that the file names,
    /// ways to put pictures on faces that are passed over.
    std::vector<std::string> remarks = {};
    friend bool operator==(const ModelReport&, const ModelReport&) = default;
};

/// Whether this build of the library has what it takes: 3MF takes libzip and expat, AMF expat
/// (libzip where it is zipped), GLB nlohmann-json; STEP and DXF take nothing, but the library of
/// scripts/demo lacks them.
[[nodiscard]] bool is_available(MeshFormat format) noexcept;

/// Whether files of a format hold parts, names and materials.
[[nodiscard]] bool holds_models(MeshFormat format) noexcept;

/// Errors: as read_mesh; UnsupportedError for what the reader refuses by name, and for a format
/// that is not available.
[[nodiscard]] Model read_model(const std::filesystem::path& path, const ReadOptions& options = {},
                               ModelReport* report = nullptr);

/// Reads bytes that are already in memory; `name` stands for the file in messages.
[[nodiscard]] Model read_model(std::string_view data, MeshFormat format, const std::string& name,
                               const ReadOptions& options = {}, ModelReport* report = nullptr);

}  // namespace trisect
