// SPDX-License-Identifier: Apache-2.0
//
// Model: parts of a file, with names and materials.
// A file may have more than one mesh. 3MF, GLB, AMF, STEP and DXF hold models; other formats hold
// one part without a name.
#pragma once

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

struct ModelMaterial {
    std::string name;
    std::optional<ModelColor> color;
    friend bool operator==(const ModelMaterial&, const ModelMaterial&) = default;
};

inline constexpr std::uint32_t no_material = 0xFFFF'FFFFU;

/// Invariant: `materials` is empty, or has one entry for each face: an index into
/// Model::materials, or no_material.
struct ModelPart {
    std::string name;
    PolygonMesh mesh;
    std::vector<std::uint32_t> materials;
    friend bool operator==(const ModelPart&, const ModelPart&) = default;
};

/// Coordinates are numbers of the file's own unit: nothing is scaled.
struct Model {
    std::string unit;  ///< "millimeter", "inch"; empty where the file does not say
    std::vector<ModelMaterial> materials;
    std::vector<ModelPart> parts;
    friend bool operator==(const Model&, const Model&) = default;
};

/// All parts in one mesh, one after the other. Where they overlap it meets itself, and winding
/// numbers above 1 are inside: the solid is their union.
[[nodiscard]] PolygonMesh merged(const Model& model);

/// A model of one part without a name.
[[nodiscard]] Model model_of(PolygonMesh mesh);

}  // namespace trisect
