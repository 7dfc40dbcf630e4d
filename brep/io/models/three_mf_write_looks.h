// SPDX-License-Identifier: Apache-2.0
//
// ThreeMfWrittenLooks: colours and textures of corners as resources of 3MF.
#pragma once

#include <trisect/brep/io/model.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Pictures that 3MF holds (PNG and JPEG with their bytes), and groups for one part after the
/// other. A triangle whose corners all have a colour, or whose material has such a picture and
/// whose corners all have texture coordinates, names a group of these; one with several, and its
/// material, multiproperties that multiply them.
class ThreeMfWrittenLooks {
public:
    /// Resources are numbered from `first_id` on; base materials are number 1.
    ThreeMfWrittenLooks(const Model& model, std::size_t first_id);

    /// Whether there is anything that base materials do not say.
    [[nodiscard]] bool is_needed() const { return is_needed_; }
    /// The text of all pictures.
    [[nodiscard]] std::string textures_text() const;
    /// Files of the package, and relationships to them.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> files() const;
    [[nodiscard]] bool has_pictures() const;

    /// Makes the groups of a part; returns their text.
    std::string begin_part(const ModelPart& part);
    /// Group and three indices of a face of that part; group 0: none.
    struct Reference {
        std::size_t group = 0;
        std::array<std::uint32_t, 3> index{};
    };
    [[nodiscard]] const Reference& of_face(std::size_t face) const { return references_[face]; }
    /// A number for another resource.
    [[nodiscard]] std::size_t take_id() { return next_id_++; }

private:
    /// Which layers a face has.
    struct Layers {
        std::uint32_t material = no_material;
        bool has_color = false;
        std::uint32_t texture = no_texture;
    };
    struct Mixture {
        std::size_t id = 0;
        std::map<std::array<std::uint32_t, 3>, std::uint32_t> rows;
        std::string text;
    };
    [[nodiscard]] Layers layers_of(const ModelPart& part, std::size_t face) const;
    void number_colors(const ModelPart& part, std::string& out);
    void number_coordinates(const ModelPart& part, std::string& out);
    Reference reference_of(const ModelPart& part, std::size_t face,
                           std::map<std::pair<std::uint32_t, unsigned>, Mixture>& mixtures);

    const Model& model_;
    std::vector<std::size_t> texture_ids_;  ///< 0: not held
    std::size_t next_id_;
    bool is_needed_ = false;
    std::vector<Reference> references_;
    std::size_t color_group_ = 0;
    std::vector<std::uint32_t> color_;                        ///< by corner: number in its group
    std::vector<std::uint32_t> coordinate_;                   ///< the same of texture coordinates
    std::map<std::uint32_t, std::size_t> coordinate_groups_;  ///< by texture
};

}  // namespace trisect::detail
