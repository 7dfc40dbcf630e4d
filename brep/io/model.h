// SPDX-License-Identifier: Apache-2.0
//
// Model: parts of a file, with names and materials.
// A file may have more than one mesh. 3MF, GLB, AMF, STEP and DXF hold models; other formats hold
// one part without a name. Textures and properties of corners are read where ReadOptions ask for
// them.
#pragma once

#include <trisect/brep/corner_properties.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trisect {

/// sRGB with opacity.
using ModelColor = std::array<std::uint8_t, 4>;

inline constexpr std::uint32_t no_texture = 0xFFFF'FFFFU;

/// What is beyond 0 to 1 in texture coordinates.
enum class TextureWrap : std::uint8_t { Repeat, Clamp, Mirror };

/// A picture. It is carried along as it is, and never looked at.
struct ModelTexture {
    std::string file;                   ///< its name beside the model; empty where there is none
    std::string media_type;             ///< "image/png", "image/jpeg"; empty: not known
    std::string bytes;                  ///< empty: known by name only
    std::array<TextureWrap, 2> wrap{};  ///< along u and v
    friend bool operator==(const ModelTexture&, const ModelTexture&) = default;
};

/// Where there is a texture as well, the colour and that of corners are factors of it.
struct ModelMaterial {
    std::string name;
    std::optional<ModelColor> color;
    std::uint32_t texture = no_texture;  ///< in Model::textures
    friend bool operator==(const ModelMaterial&, const ModelMaterial&) = default;
};

inline constexpr std::uint32_t no_material = 0xFFFF'FFFFU;

/// Invariant: `materials` is empty, or has one entry for each face: an index into
/// Model::materials, or no_material. `properties` is empty, or fits the mesh.
struct ModelPart {
    std::string name;
    PolygonMesh mesh;
    std::vector<std::uint32_t> materials;
    CornerProperties properties = {};
    friend bool operator==(const ModelPart&, const ModelPart&) = default;
};

/// Coordinates are numbers of the file's own unit: nothing is scaled.
struct Model {
    std::string unit;  ///< "millimeter", "inch"; empty where the file does not say
    std::vector<ModelMaterial> materials;
    std::vector<ModelPart> parts;
    std::vector<ModelTexture> textures = {};
    friend bool operator==(const Model&, const Model&) = default;
};

/// All parts in one mesh, one after the other. Where they overlap it meets itself, and winding
/// numbers above 1 are inside: the solid is their union.
[[nodiscard]] PolygonMesh merged(const Model& model);

/// The same with the materials and properties of all parts.
[[nodiscard]] ModelPart merged_part(const Model& model);

/// A model of one part without a name.
[[nodiscard]] Model model_of(PolygonMesh mesh);

}  // namespace trisect
