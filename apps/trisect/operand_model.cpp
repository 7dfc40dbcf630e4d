// SPDX-License-Identifier: Apache-2.0
#include "operand_model.h"

#include <trisect/brep/io/property_colors.h>
#include <trisect/bsp/property_mesh.h>

#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

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

/// Materials and pictures of all operands, one after the other, as far as faces of the result have
/// them.
class MaterialList {
public:
    void add(const Operand& operand, std::size_t number) {
        Entry entry;
        entry.own = material_of(operand, number);
        if (operand.model != nullptr) {
            entry.model = operand.model.get();
            entry.part = &operand.model->parts.front();
            const CornerProperties& p = entry.part->properties;
            // A colour of the operand's would tint those of its corners.
            if (p.column_of(PropertyMeaning::Color) || p.column_of(PropertyMeaning::LinearColor))
                entry.own.color.reset();
            entry.numbers.assign(entry.model->materials.size(), no_material);
        }
        by_source_.emplace(operand.solid.source_id(), entries_.size());
        entries_.push_back(std::move(entry));
    }

    /// Where the number of the material of a face will be; null: it has none.
    std::uint32_t* number_of(const FaceSource& source) {
        const auto found = by_source_.find(source.operand);
        if (found == by_source_.end()) return nullptr;
        Entry& entry = entries_[found->second];
        if (entry.part != nullptr && source.face < entry.part->materials.size()) {
            const std::uint32_t material = entry.part->materials[source.face];
            if (material != no_material) return &entry.numbers[material];
        }
        return &entry.own_number;
    }

    /// Numbers what `number_of` marked with `used`.
    static constexpr std::uint32_t used = 0;
    void number_into(Model& model) {
        for (Entry& entry : entries_) {
            std::vector<std::uint32_t> textures;
            if (entry.model != nullptr) textures.resize(entry.model->textures.size(), no_texture);
            for (std::size_t i = 0; i < entry.numbers.size(); ++i) {
                if (entry.numbers[i] != used) continue;
                entry.numbers[i] = static_cast<std::uint32_t>(model.materials.size());
                model.materials.push_back(entry.model->materials[i]);
                std::uint32_t& texture = model.materials.back().texture;
                if (texture == no_texture) continue;
                std::uint32_t& known = textures[texture];
                if (known == no_texture) {
                    known = static_cast<std::uint32_t>(model.textures.size());
                    model.textures.push_back(entry.model->textures[texture]);
                }
                texture = known;
            }
            if (entry.own_number != used) continue;
            entry.own_number = static_cast<std::uint32_t>(model.materials.size());
            model.materials.push_back(entry.own);
        }
    }

private:
    struct Entry {
        const Model* model = nullptr;
        const ModelPart* part = nullptr;
        ModelMaterial own;  ///< of faces without one
        std::uint32_t own_number = no_material;
        std::vector<std::uint32_t> numbers{};  ///< of the operand's materials in the result
    };
    std::vector<Entry> entries_;
    std::unordered_map<std::uint32_t, std::size_t> by_source_;
};

}  // namespace

Model property_model(PolygonMesh mesh, std::vector<FaceSource> sources,
                     const std::vector<Operand>& operands, const std::string& name,
                     MeshFormat format) {
    Model model;
    model.unit = common_unit(operands);
    MaterialList list;
    std::vector<PropertyOperand> named;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        list.add(operands[i], i);
        if (operands[i].model == nullptr) continue;
        ModelPart& part = operands[i].model->parts.front();
        convert_colors(part.properties, has_linear_colors(format));
        named.push_back({operands[i].solid.source_id(), &part.mesh, &part.properties});
    }
    PropertyMesh made = with_properties(std::move(mesh), std::move(sources), named);
    for (const FaceSource& source : made.source)
        if (std::uint32_t* const number = list.number_of(source)) *number = MaterialList::used;
    list.number_into(model);
    ModelPart part;
    part.name = name;
    part.materials.reserve(made.source.size());
    for (const FaceSource& source : made.source) {
        const std::uint32_t* const number = list.number_of(source);
        part.materials.push_back(number == nullptr ? no_material : *number);
    }
    part.mesh = std::move(made.mesh);
    part.properties = std::move(made.properties);
    model.parts.push_back(std::move(part));
    return model;
}

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
