// SPDX-License-Identifier: Apache-2.0
//
// OBJ and PLY with materials, textures and properties of corners.
// The plain readers have read and checked the same bytes before; these make another pass.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/model.h>
#include <trisect/brep/io/properties/beside_files.h>
#include <trisect/brep/io/write_mesh.h>

#include <string>

namespace trisect::detail {

/// \param mesh what the plain reader made of these bytes
/// \throw InputError with the place, LimitError
[[nodiscard]] Model read_obj_properties(const InputText& source, PolygonMesh mesh,
                                        BesideFiles& files);
[[nodiscard]] Model read_ply_properties(const InputText& source, PolygonMesh mesh,
                                        BesideFiles& files);

/// \pre the model was checked (see write_mesh.cpp)
[[nodiscard]] FormattedMesh write_obj_properties(const Model& model, const std::string& name);
[[nodiscard]] FormattedMesh write_ply_properties(const Model& model, PlyEncoding encoding,
                                                 const std::string& name);

}  // namespace trisect::detail
