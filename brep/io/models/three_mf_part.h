// SPDX-License-Identifier: Apache-2.0
//
// ThreeMfPart: a model part of a 3MF package.
// It is parsed, and not yet put together.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/model.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace trisect::detail {

/// A component of an object, or an item of the build.
struct ThreeMfUse {
    std::uint64_t object = 0;
    std::string path;  ///< of the part that has the object; empty: this one
    std::array<double, 12> rows{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const char* at = nullptr;
};

/// A picture: an entry of the package.
struct ThreeMfTexture {
    std::string path;
    ModelTexture texture;  ///< without bytes
    const char* at = nullptr;
};

struct ThreeMfObject {
    std::string name;
    bool is_support = false;
    bool has_mesh = false;
    PolygonMesh mesh;
    std::vector<std::uint32_t> materials;  ///< indices into ThreeMfPart::materials
    CornerProperties properties;
    std::vector<ThreeMfUse> components;
    const char* at = nullptr;
};

/// Places in it point into `text`, so it stays where it is.
struct ThreeMfPart {
    ThreeMfPart(std::string part_text, const std::string& name, const ReadLimits& limits)
        : text(std::move(part_text)), source(text, name, limits, false) {}
    ThreeMfPart(const ThreeMfPart&) = delete;
    ThreeMfPart& operator=(const ThreeMfPart&) = delete;

    std::string text;
    InputText source;
    std::string unit = "millimeter";
    std::vector<ModelMaterial> materials;
    std::vector<ThreeMfTexture> textures;
    std::map<std::uint64_t, ThreeMfObject> objects;
    std::vector<ThreeMfUse> items;
    bool has_build = false;
};

/// Parses the text of a part; `with_properties`: colours and textures of corners are no materials.
/// \throw InputError, LimitError, UnsupportedError
[[nodiscard]] std::unique_ptr<ThreeMfPart> parse_three_mf_part(std::string text,
                                                               const std::string& name,
                                                               const ReadLimits& limits,
                                                               bool with_properties);

}  // namespace trisect::detail
