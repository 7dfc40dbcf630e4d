// SPDX-License-Identifier: Apache-2.0
#include "operand_model.h"

#include <filesystem>
#include <unordered_map>

#include "color.h"

namespace trisect::app {
namespace {

ModelMaterial material_of(const Operand& operand, std::size_t number) {
    const Color color = operand_color(number);
    const std::filesystem::path file = operand.facts["file"].get<std::string>();
    return {file.filename().string(),
            ModelColor{color.channel(0), color.channel(1), color.channel(2), 255}};
}

std::string common_unit(const std::vector<Operand>& operands) {
    std::string unit;
    for (const Operand& operand : operands) {
        const auto found = operand.facts.find("unit");
        if (found == operand.facts.end() || found->is_null()) continue;
        const auto own = found->get<std::string>();
        if (!unit.empty() && own != unit) return {};
        unit = own;
    }
    return unit;
}

}  // namespace

Model operand_model(PolygonMesh mesh, std::span<const FaceSource> sources,
                    const std::vector<Operand>& operands, const std::string& name) {
    Model model;
    model.unit = common_unit(operands);
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        numbers.emplace(operands[i].solid.source_id(), static_cast<std::uint32_t>(i));
        model.materials.push_back(material_of(operands[i], i));
    }
    std::vector<std::uint32_t> materials;
    materials.reserve(sources.size());
    for (const FaceSource& source : sources) {
        const auto found = numbers.find(source.operand);
        materials.push_back(found == numbers.end() ? no_material : found->second);
    }
    model.parts.push_back({name, std::move(mesh), std::move(materials)});
    return model;
}

}  // namespace trisect::app
