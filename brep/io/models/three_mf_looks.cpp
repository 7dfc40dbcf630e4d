// SPDX-License-Identifier: Apache-2.0
//
// 3MF Materials and Properties Extension 1.2. A group is used after it was defined, so triangles
// find all groups that there are. Colours are those of corners, in sRGB; v is upward.
#include <trisect/brep/io/models/three_mf_looks.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_layers = 16;

TextureWrap wrap_of(const XmlElement& element, std::string_view name) {
    const std::string_view style = trimmed_word(element.attribute(name).value_or("wrap"));
    if (style == "mirror") return TextureWrap::Mirror;
    return style == "wrap" ? TextureWrap::Repeat : TextureWrap::Clamp;
}

}  // namespace

void ThreeMfLooks::begin_colors(std::uint64_t id) {
    current_ = &groups_[id];
    current_->width = color_width;
}

void ThreeMfLooks::begin_coordinates(std::uint64_t id, const XmlElement& element) {
    current_ = &groups_[id];
    current_->meaning = PropertyMeaning::TextureCoordinates;
    current_->width = uv_width;
    const std::uint64_t texture = xml_count(part_.source, element.required(part_.source, "texid"),
                                            "the number of a texture", element.at);
    const auto found = textures_.find(texture);
    if (found == textures_.end())
        part_.source.fail(element.at, "there is no texture " + std::to_string(texture));
    current_->texture = found->second;
}

void ThreeMfLooks::begin_mixtures(std::uint64_t id, const XmlElement& element) {
    current_ = &groups_[id];
    current_->is_mixture = true;
    std::string_view words = element.required(part_.source, "pids");
    for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
        if (current_->layers.size() == most_layers)
            part_.source.fail_limit(element.at, "multiproperties of more than " +
                                                    std::to_string(most_layers) + " layers");
        current_->layers.push_back(
            xml_count(part_.source, word, "the number of a resource", element.at));
    }
}

void ThreeMfLooks::add_color(const ModelColor& color) {
    for (const std::uint8_t level : color) current_->rows.push_back(level / 255.0);
}

void ThreeMfLooks::add_coordinates(const XmlElement& element) {
    for (const char* name : {"u", "v"})
        current_->rows.push_back(xml_real(part_.source, element.required(part_.source, name),
                                          "a texture coordinate", element.at));
}

/// Numbers that are not there are 0.
void ThreeMfLooks::add_mixture(const XmlElement& element) {
    std::string_view words = element.required(part_.source, "pindices");
    for (std::size_t i = 0; i < current_->layers.size(); ++i) {
        const std::string_view word = take_word(words);
        current_->mixtures.push_back(
            word.empty() ? 0
                         : xml_count(part_.source, word, "the index of a property", element.at));
    }
}

void ThreeMfLooks::add_texture(const XmlElement& element) {
    const std::uint64_t id = xml_count(part_.source, element.required(part_.source, "id"),
                                       "the number of a resource", element.at);
    ThreeMfTexture made;
    made.path = trimmed_word(element.required(part_.source, "path"));
    made.at = element.at;
    made.texture.media_type = trimmed_word(element.attribute("contenttype").value_or(""));
    made.texture.wrap = {wrap_of(element, "tilestyleu"), wrap_of(element, "tilestylev")};
    if (!textures_.emplace(id, static_cast<std::uint32_t>(part_.textures.size())).second)
        part_.source.fail(element.at, "two resources with the number " + std::to_string(id));
    part_.textures.push_back(std::move(made));
}

std::uint32_t ThreeMfLooks::triangle(std::uint64_t group,
                                     const std::array<std::uint64_t, 3>& numbers,
                                     std::size_t corner, const BaseMaterial& base,
                                     const XmlElement& element) {
    Look look;
    const auto found = groups_.find(group);
    if (found != groups_.end() && found->second.is_mixture)
        mixture(found->second, numbers, corner, base, element, look);
    else
        layer(group, numbers, corner, base, element, look);
    return material_of(look);
}

void ThreeMfLooks::mixture(const Group& group, const std::array<std::uint64_t, 3>& numbers,
                           std::size_t corner, const BaseMaterial& base, const XmlElement& element,
                           Look& look) {
    const std::size_t layers = group.layers.size();
    if (layers == 0) return;
    for (const std::uint64_t number : numbers)
        check(number, group.mixtures.size() / layers, 0, element);
    for (std::size_t i = 0; i < layers; ++i) {
        std::array<std::uint64_t, 3> inner{};
        for (std::size_t k = 0; k < 3; ++k)
            inner[k] = group.mixtures[static_cast<std::size_t>(numbers[k]) * layers + i];
        layer(group.layers[i], inner, corner, base, element, look);
    }
}

void ThreeMfLooks::layer(std::uint64_t id, const std::array<std::uint64_t, 3>& numbers,
                         std::size_t corner, const BaseMaterial& base, const XmlElement& element,
                         Look& look) {
    const auto found = groups_.find(id);
    if (found == groups_.end()) {
        const std::uint32_t material = base(id, numbers[0]);
        if (material != no_material) look.base = material;
        return;
    }
    const Group& group = found->second;
    if (group.is_mixture) part_.source.fail(element.at, "multiproperties of multiproperties");
    const bool is_color = group.meaning == PropertyMeaning::Color;
    const std::size_t channel = is_color ? properties_.color() : properties_.uv();
    for (std::size_t k = 0; k < 3; ++k) {
        check(numbers[k], group.rows.size() / group.width, id, element);
        const std::size_t first = static_cast<std::size_t>(numbers[k]) * group.width;
        properties_.set(channel, corner + k, std::span(group.rows).subspan(first, group.width),
                        element.at);
    }
    if (!is_color) look.texture = group.texture;
}

void ThreeMfLooks::check(std::uint64_t number, std::uint64_t count, std::uint64_t id,
                         const XmlElement& element) const {
    if (number < count) return;
    part_.source.fail(element.at,
                      "property " + std::to_string(number) + " of " +
                          (id == 0 ? std::string("multiproperties, which have ")
                                   : "resource " + std::to_string(id) + ", which has ") +
                          std::to_string(count));
}

std::uint32_t ThreeMfLooks::material_of(const Look& look) {
    if (look.texture == no_texture) return look.base;
    const auto next = static_cast<std::uint32_t>(part_.materials.size());
    const auto [found, is_new] = materials_.emplace(std::pair(look.base, look.texture), next);
    if (!is_new) return found->second;
    ModelMaterial made{"", std::nullopt};
    if (look.base != no_material) made = part_.materials[look.base];
    made.texture = look.texture;
    part_.materials.push_back(std::move(made));
    return next;
}

CornerProperties ThreeMfLooks::finish_mesh(std::size_t corners) {
    CornerProperties out = properties_.finish(corners);
    properties_ = PropertyCollector(part_.source);
    return out;
}

}  // namespace trisect::detail
