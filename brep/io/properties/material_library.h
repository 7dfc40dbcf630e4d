// SPDX-License-Identifier: Apache-2.0
//
// Material libraries of OBJ (MTL): names, diffuse colours, opacity, pictures.
// Everything else in them concerns light and is passed over.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/properties/beside_files.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// A material as a library has it; the picture is a name.
struct LibraryMaterial {
    std::optional<ModelColor> color;
    std::string picture;
    TextureWrap wrap = TextureWrap::Repeat;
};

/// Adds the materials of a library; of two with one name the later one counts.
/// \throw InputError with line and column, LimitError
void read_material_library(std::string_view text, const std::string& name, const ReadLimits& limits,
                           BesideFiles& files, std::map<std::string, LibraryMaterial>& materials);

/// The text of a library: material `i` of the model has the i-th name, texture `i` the i-th file.
[[nodiscard]] std::string material_library(const Model& model,
                                           const std::vector<std::string>& names,
                                           const std::vector<std::string>& pictures);

}  // namespace trisect::detail
