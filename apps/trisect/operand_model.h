// SPDX-License-Identifier: Apache-2.0
//
// Results of booleans as models: a material for each operand.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/io/model.h>

#include <span>
#include <string>
#include <vector>

#include "operand.h"

namespace trisect::app {

/// One part, whose faces have the material of the operand that they come from: its file's name and
/// its colour in pictures. The unit is that of all operands that have one, if they agree.
/// \pre `sources` has one entry for each face of the mesh
[[nodiscard]] Model operand_model(PolygonMesh mesh, std::span<const FaceSource> sources,
                                  const std::vector<Operand>& operands, const std::string& name);

/// The same with all that the operands' files say of how their faces look: materials, textures,
/// properties of corners, which are interpolated in the numbers that the format has. A face without
/// a material has that of its operand.
/// \pre the mesh has triangles only, each within one face of an operand
[[nodiscard]] Model property_model(PolygonMesh mesh, std::vector<FaceSource> sources,
                                   const std::vector<Operand>& operands, const std::string& name,
                                   MeshFormat format);

}  // namespace trisect::app
