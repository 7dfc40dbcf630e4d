// SPDX-License-Identifier: Apache-2.0
//
// Readers and writers of single formats, called by read_mesh and write_mesh.
// Writers are given a mesh that was checked (see write_mesh.cpp) and append to `out`.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/polygon_mesh.h>

#include <string>

namespace trisect::detail {

[[nodiscard]] PolygonMesh read_obj(const InputText& source);
[[nodiscard]] PolygonMesh read_off(const InputText& source);
[[nodiscard]] PolygonMesh read_ply(const InputText& source);
[[nodiscard]] PolygonMesh read_stl_ascii(const InputText& source);
[[nodiscard]] PolygonMesh read_stl_binary(const InputText& source);

void write_obj(std::string& out, const PolygonMesh& mesh);
void write_off(std::string& out, const PolygonMesh& mesh);
void write_ply(std::string& out, const PolygonMesh& mesh, PlyEncoding encoding);
void write_stl_ascii(std::string& out, const PolygonMesh& mesh);
/// `name` stands for the file in errors.
WriteReport write_stl_binary(std::string& out, const PolygonMesh& mesh, const std::string& name);

}  // namespace trisect::detail
