// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/written_properties.h>

#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/brep/io/property_colors.h>

#include <algorithm>
#include <map>
#include <set>

namespace trisect::detail {

std::vector<std::string> distinct_names(const Model& model) {
    std::vector<std::string> out;
    std::set<std::string> taken;
    std::map<std::string, std::size_t> uses;
    for (const ModelMaterial& material : model.materials) {
        std::string name = material.name;
        for (char& c : name)
            if (static_cast<unsigned char>(c) < ' ' || c == '#' || c == '\\' || c == '\x7F')
                c = '_';
        while (!name.empty() && name.back() == ' ') name.pop_back();
        while (!name.empty() && name.front() == ' ') name.erase(0, 1);
        if (name.empty()) name = "material";
        std::string distinct = name;
        // Counting on from the last one keeps a million equal names from taking hours.
        while (!taken.insert(distinct).second)
            distinct = name + "_" + std::to_string(++uses[name] + 1);
        out.push_back(std::move(distinct));
    }
    return out;
}

WrittenProperties written_properties(const Model& model, const std::string& name) {
    WrittenProperties out;
    out.part = merged_part(model);
    convert_colors(out.part.properties, false);
    out.material_names = distinct_names(model);
    for (std::size_t i = 0; i < model.textures.size(); ++i) {
        const ModelTexture& texture = model.textures[i];
        if (texture.bytes.empty()) {
            const bool is_plain =
                std::none_of(texture.file.begin(), texture.file.end(),
                             [](char c) { return static_cast<unsigned char>(c) < ' '; });
            out.pictures.push_back(is_plain ? texture.file : "");
            continue;
        }
        std::string file = stem_of(name) + "_" + std::to_string(i + 1) +
                           extension_of_media(media_type_of(texture.bytes, texture.file));
        out.pictures.push_back(file);
        out.files.push_back({std::move(file), texture.bytes});
    }
    return out;
}

NumberRows corner_rows(const ModelPart& part, std::size_t first, std::size_t width,
                       bool with_vertex) {
    NumberRows out;
    out.width = width + (with_vertex ? 1 : 0);
    out.values.reserve(out.width * part.mesh.corners.size());
    for (std::size_t c = 0; c < part.mesh.corners.size(); ++c) {
        if (with_vertex) out.values.push_back(part.mesh.corners[c]);
        if (width == 0) continue;
        const auto numbers = part.properties.at(c).subspan(first, width);
        out.values.insert(out.values.end(), numbers.begin(), numbers.end());
    }
    return out;
}

}  // namespace trisect::detail
