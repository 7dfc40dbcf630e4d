// SPDX-License-Identifier: Apache-2.0
//
// ThreeMfLooks: colours, textures and mixtures of the triangles of a 3MF part.
#pragma once

#include <trisect/brep/io/models/three_mf_part.h>
#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/brep/io/properties/property_collector.h>

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Groups of colours and of texture coordinates, and multiproperties, by their numbers. A triangle
/// with a picture has a material of its own for each pair of base material and picture.
class ThreeMfLooks {
public:
    explicit ThreeMfLooks(ThreeMfPart& part) : part_(part), properties_(part.source) {}

    void begin_colors(std::uint64_t id);
    void begin_coordinates(std::uint64_t id, const XmlElement& element);
    void begin_mixtures(std::uint64_t id, const XmlElement& element);
    void add_color(const ModelColor& color);
    void add_coordinates(const XmlElement& element);
    void add_mixture(const XmlElement& element);
    void add_texture(const XmlElement& element);

    /// The base material of a group of these, or no_material.
    using BaseMaterial = std::function<std::uint32_t(std::uint64_t group, std::uint64_t number)>;
    /// What a triangle has from its group, for the corners from `corner` on; its material.
    std::uint32_t triangle(std::uint64_t group, const std::array<std::uint64_t, 3>& numbers,
                           std::size_t corner, const BaseMaterial& base, const XmlElement& element);
    /// The properties of the mesh that ends.
    [[nodiscard]] CornerProperties finish_mesh(std::size_t corners);

private:
    struct Group {
        bool is_mixture = false;
        PropertyMeaning meaning = PropertyMeaning::Color;
        std::size_t width = 0;
        std::vector<double> rows;               ///< of colours or texture coordinates
        std::uint32_t texture = no_texture;     ///< in ThreeMfPart::textures
        std::vector<std::uint64_t> layers;      ///< of mixtures: groups
        std::vector<std::uint64_t> mixtures{};  ///< numbers in these, mixture by mixture
    };

    /// Material and picture that the layers of a triangle amount to.
    struct Look {
        std::uint32_t base = no_material;
        std::uint32_t texture = no_texture;
    };
    void layer(std::uint64_t id, const std::array<std::uint64_t, 3>& numbers, std::size_t corner,
               const BaseMaterial& base, const XmlElement& element, Look& look);
    void mixture(const Group& group, const std::array<std::uint64_t, 3>& numbers,
                 std::size_t corner, const BaseMaterial& base, const XmlElement& element,
                 Look& look);
    std::uint32_t material_of(const Look& look);
    void check(std::uint64_t number, std::uint64_t count, std::uint64_t id,
               const XmlElement& element) const;

    ThreeMfPart& part_;
    PropertyCollector properties_;
    std::map<std::uint64_t, Group> groups_;
    Group* current_ = nullptr;
    std::map<std::uint64_t, std::uint32_t> textures_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> materials_;
};

}  // namespace trisect::detail
