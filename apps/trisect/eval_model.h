// SPDX-License-Identifier: Apache-2.0
//
// Results of programs as models: a material for each colour.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/io/model.h>
#include <trisect/bsp/csg/csg_evaluate.h>

#include <span>
#include <string>

namespace trisect::app {

/// Whether files of a format can have colours of faces.
[[nodiscard]] bool holds_colors(MeshFormat format);

/// Whether color() is in a program.
[[nodiscard]] bool has_colors(const CsgTree& tree);

/// One part, whose faces have the colours that the report says; others have no material.
/// \pre `sources` has one entry for each face of the mesh
[[nodiscard]] Model colored_model(PolygonMesh mesh, std::span<const FaceSource> sources,
                                  const CsgReport& report, const std::string& name);

}  // namespace trisect::app
