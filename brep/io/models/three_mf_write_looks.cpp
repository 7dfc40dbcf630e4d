// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/three_mf_write_looks.h>

#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/models/three_mf_names.h>
#include <trisect/brep/io/models/xml_text.h>
#include <trisect/brep/io/properties/distinct_rows.h>
#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/brep/io/property_colors.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trisect::detail {
namespace {

constexpr std::string_view texture_relation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture";
constexpr std::uint32_t unnumbered = 0xFFFF'FFFFU;

std::string type_of(const ModelTexture& texture) {
    return media_type_of(texture.bytes, texture.file);
}

std::string style_of(TextureWrap wrap) {
    if (wrap == TextureWrap::Clamp) return "clamp";
    return wrap == TextureWrap::Mirror ? "mirror" : "wrap";
}

std::string path_of(const ModelTexture& texture, std::size_t number) {
    return "3D/Textures/texture" + std::to_string(number + 1) +
           extension_of_media(type_of(texture));
}

std::string hex_byte(double value) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto level = static_cast<std::size_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    return {digits[level / 16], digits[level % 16]};
}

/// Whether all corners of a face have all numbers of some columns.
bool has_all(const ModelPart& part, std::size_t face, std::optional<std::size_t> column,
             std::size_t width) {
    if (!column) return false;
    for (std::size_t c = part.mesh.face_begin[face]; c < part.mesh.face_begin[face + 1]; ++c)
        for (const double x : part.properties.at(c).subspan(*column, width))
            if (std::isnan(x)) return false;
    return true;
}

}  // namespace

ThreeMfWrittenLooks::ThreeMfWrittenLooks(const Model& model, std::size_t first_id)
    : model_(model), next_id_(first_id) {
    for (const ModelTexture& texture : model.textures) {
        const std::string type = type_of(texture);
        const bool is_held =
            !texture.bytes.empty() && (type == "image/png" || type == "image/jpeg");
        texture_ids_.push_back(is_held ? next_id_++ : 0);
    }
    for (const ModelPart& part : model.parts) is_needed_ = is_needed_ || part.properties.width != 0;
}

bool ThreeMfWrittenLooks::has_pictures() const {
    return is_needed_ && std::any_of(texture_ids_.begin(), texture_ids_.end(),
                                     [](std::size_t id) { return id != 0; });
}

std::string ThreeMfWrittenLooks::textures_text() const {
    std::string out;
    for (std::size_t i = 0; has_pictures() && i < texture_ids_.size(); ++i) {
        if (texture_ids_[i] == 0) continue;
        const ModelTexture& texture = model_.textures[i];
        out += "  <m:texture2d id=\"" + std::to_string(texture_ids_[i]) + "\" path=\"/" +
               path_of(texture, i) + "\" contenttype=\"" + type_of(texture) + "\" tilestyleu=\"" +
               style_of(texture.wrap[0]) + "\" tilestylev=\"" + style_of(texture.wrap[1]) +
               "\"/>\n";
    }
    return out;
}

std::vector<std::pair<std::string, std::string>> ThreeMfWrittenLooks::files() const {
    std::vector<std::pair<std::string, std::string>> out;
    if (!has_pictures()) return out;
    std::string relations = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"" +
                            std::string(package_relations) + "\">\n";
    for (std::size_t i = 0; i < texture_ids_.size(); ++i) {
        if (texture_ids_[i] == 0) continue;
        const std::string path = path_of(model_.textures[i], i);
        relations += " <Relationship Id=\"tex" + std::to_string(i) + "\" Target=\"/" + path +
                     "\" Type=\"" + std::string(texture_relation) + "\"/>\n";
        out.emplace_back(path, model_.textures[i].bytes);
    }
    out.emplace_back("3D/_rels/3dmodel.model.rels", relations + "</Relationships>\n");
    return out;
}

ThreeMfWrittenLooks::Layers ThreeMfWrittenLooks::layers_of(const ModelPart& part,
                                                           std::size_t face) const {
    Layers out;
    if (!part.materials.empty()) out.material = part.materials[face];
    out.has_color = has_all(part, face, part.properties.column_of(PropertyMeaning::Color), 4);
    if (out.material == no_material) return out;
    const std::uint32_t texture = model_.materials[out.material].texture;
    if (texture != no_texture && texture_ids_[texture] != 0 &&
        has_all(part, face, part.properties.column_of(PropertyMeaning::TextureCoordinates), 2))
        out.texture = texture;
    return out;
}

void ThreeMfWrittenLooks::number_colors(const ModelPart& part, std::string& out) {
    const auto column = part.properties.column_of(PropertyMeaning::Color);
    color_.assign(part.mesh.corners.size(), 0);
    if (!column) return;
    NumberRows rows;
    rows.width = 4;
    for (std::size_t c = 0; c < part.mesh.corners.size(); ++c)
        for (const double x : part.properties.at(c).subspan(*column, 4))
            rows.values.push_back(std::isnan(x) ? 0
                                                : std::round(255 * std::clamp(x, 0.0, 1.0)) / 255);
    DistinctRows distinct = distinct_rows(rows);
    color_group_ = next_id_++;
    out += "  <m:colorgroup id=\"" + std::to_string(color_group_) + "\">\n";
    for (const std::size_t row : distinct.first) {
        out += "   <m:color color=\"#";
        for (std::size_t i = 0; i < 4; ++i) out += hex_byte(rows.values[4 * row + i]);
        out += "\"/>\n";
    }
    out += "  </m:colorgroup>\n";
    color_ = std::move(distinct.number);
}

void ThreeMfWrittenLooks::number_coordinates(const ModelPart& part, std::string& out) {
    coordinate_groups_.clear();
    coordinate_.assign(part.mesh.corners.size(), 0);
    const auto column = part.properties.column_of(PropertyMeaning::TextureCoordinates);
    if (!column) return;
    // One group for each picture; rows are distinct in it.
    std::map<std::uint32_t, std::vector<std::size_t>> corners;
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
        const std::uint32_t texture = layers_of(part, f).texture;
        if (texture == no_texture) continue;
        for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1]; ++c)
            corners[texture].push_back(c);
    }
    for (const auto& [texture, own] : corners) {
        NumberRows rows;
        rows.width = 2;
        for (const std::size_t c : own) {
            const auto uv = part.properties.at(c).subspan(*column, 2);
            rows.values.insert(rows.values.end(), uv.begin(), uv.end());
        }
        const DistinctRows distinct = distinct_rows(rows);
        for (std::size_t i = 0; i < own.size(); ++i) coordinate_[own[i]] = distinct.number[i];
        const std::size_t id = coordinate_groups_[texture] = next_id_++;
        out += "  <m:texture2dgroup id=\"" + std::to_string(id) + "\" texid=\"" +
               std::to_string(texture_ids_[texture]) + "\">\n";
        TextWriter text(out);
        for (const std::size_t row : distinct.first)
            text << "   <m:tex2coord u=\"" << rows.values[2 * row] << "\" v=\""
                 << rows.values[2 * row + 1] << "\"/>\n";
        text.finish();
        out += "  </m:texture2dgroup>\n";
    }
}

ThreeMfWrittenLooks::Reference ThreeMfWrittenLooks::reference_of(
    const ModelPart& part, std::size_t face,
    std::map<std::pair<std::uint32_t, unsigned>, Mixture>& mixtures) {
    const Layers layers = layers_of(part, face);
    const std::size_t first = part.mesh.face_begin[face];
    std::vector<Reference> own;
    if (layers.material != no_material)
        own.push_back({1, {layers.material, layers.material, layers.material}});
    if (layers.has_color)
        own.push_back({color_group_, {color_[first], color_[first + 1], color_[first + 2]}});
    if (layers.texture != no_texture)
        own.push_back({coordinate_groups_[layers.texture],
                       {coordinate_[first], coordinate_[first + 1], coordinate_[first + 2]}});
    if (own.empty()) return {};
    if (own.size() == 1) return own.front();
    const unsigned kinds =
        (layers.material != no_material ? 1U : 0U) | (layers.has_color ? 2U : 0U);
    Mixture& mixture = mixtures[{layers.texture, kinds}];
    if (mixture.id == 0) {
        mixture.id = next_id_++;
        mixture.text = "  <m:multiproperties id=\"" + std::to_string(mixture.id) + "\" pids=\"";
        for (const Reference& r : own) mixture.text += std::to_string(r.group) + " ";
        mixture.text.back() = '"';
        mixture.text += own.size() == 2 ? " blendmethods=\"multiply\">\n"
                                        : " blendmethods=\"multiply multiply\">\n";
    }
    Reference out{mixture.id, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<std::uint32_t, 3> row{unnumbered, unnumbered, unnumbered};
        for (std::size_t i = 0; i < own.size(); ++i) row[i] = own[i].index[k];
        const auto [known, is_new] =
            mixture.rows.emplace(row, static_cast<std::uint32_t>(mixture.rows.size()));
        if (is_new) {
            mixture.text += "   <m:multi pindices=\"";
            for (std::size_t i = 0; i < own.size(); ++i)
                mixture.text += std::to_string(row[i]) + (i + 1 == own.size() ? "\"/>\n" : " ");
        }
        out.index[k] = known->second;
    }
    return out;
}

std::string ThreeMfWrittenLooks::begin_part(const ModelPart& part) {
    std::string out;
    number_colors(part, out);
    number_coordinates(part, out);
    std::map<std::pair<std::uint32_t, unsigned>, Mixture> mixtures;
    references_.clear();
    references_.reserve(part.mesh.face_count());
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f)
        references_.push_back(reference_of(part, f, mixtures));
    for (const auto& [key, mixture] : mixtures) out += mixture.text + "  </m:multiproperties>\n";
    return out;
}

}  // namespace trisect::detail
