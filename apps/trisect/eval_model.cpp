// SPDX-License-Identifier: Apache-2.0
#include "eval_model.h"

#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace trisect::app {
namespace {

ModelMaterial material_of(const CsgColor& color) {
    ModelColor out{};
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0, 1.0)));
    return {fmt::format("#{:02x}{:02x}{:02x}{:02x}", out[0], out[1], out[2], out[3]), out};
}

}  // namespace

bool holds_colors(MeshFormat format) { return holds_models(format) || holds_properties(format); }

bool has_colors(const CsgTree& tree) {
    return std::ranges::any_of(tree.nodes, [](const CsgNode& n) { return n.name == "color"; });
}

Model colored_model(PolygonMesh mesh, std::span<const FaceSource> sources, const CsgReport& report,
                    const std::string& name) {
    Model model;
    ModelPart part;
    part.name = name;
    std::vector<std::uint32_t> numbers(report.colors.size(), no_material);
    for (const FaceSource& source : sources) {
        const auto color = report.color_of_source.find(source.operand);
        if (color == report.color_of_source.end()) {
            part.materials.push_back(no_material);
            continue;
        }
        std::uint32_t& number = numbers[color->second];
        if (number == no_material) {
            number = static_cast<std::uint32_t>(model.materials.size());
            model.materials.push_back(material_of(report.colors[color->second]));
        }
        part.materials.push_back(number);
    }
    part.mesh = std::move(mesh);
    model.parts.push_back(std::move(part));
    return model;
}

}  // namespace trisect::app
