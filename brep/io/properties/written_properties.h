// SPDX-License-Identifier: Apache-2.0
//
// WrittenProperties: a model as OBJ and PLY get it.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/properties/distinct_rows.h>
#include <trisect/brep/io/write_mesh.h>

#include <string>
#include <vector>

namespace trisect::detail {

/// One mesh of all parts.
struct WrittenProperties {
    ModelPart part;                           ///< colours are sRGB
    std::vector<std::string> material_names;  ///< distinct, of one line
    std::vector<std::string> pictures;        ///< file names by texture; empty: none
    std::vector<SideFile> files;              ///< the pictures

    [[nodiscard]] std::uint32_t material(std::size_t face) const {
        return part.materials.empty() ? no_material : part.materials[face];
    }
};

/// `name` is that of the file: pictures are called after it.
[[nodiscard]] WrittenProperties written_properties(const Model& model, const std::string& name);

/// Texts that are names of a material or picture in a line, and differ from each other.
[[nodiscard]] std::vector<std::string> distinct_names(const Model& model);

/// Columns `first` to `first + width - 1` of each corner, behind the number of its vertex if
/// `with_vertex`.
[[nodiscard]] NumberRows corner_rows(const ModelPart& part, std::size_t first, std::size_t width,
                                     bool with_vertex);

}  // namespace trisect::detail
