// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the readers that keep properties. The first byte of an input chooses the format,
// unless TRISECT_FUZZ_FORMAT says its number: OBJ, PLY, GLB, the model part of a 3MF package, a
// material library. What is read must have the mesh that the plain reader has, keep its invariants,
// and go into every format that holds properties, and come back from there.
#include <trisect/brep/io/models/zip_archive.h>
#include <trisect/brep/io/properties/material_library.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/kernel/error.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace {

using trisect::MeshFormat;
using trisect::Model;
using trisect::ModelPart;

void require(bool condition) {
    if (!condition) std::abort();
}

void check_invariants(const Model& model) {
    for (const ModelPart& part : model.parts) {
        require(part.materials.empty() || part.materials.size() == part.mesh.face_count());
        for (const std::uint32_t m : part.materials)
            require(m == trisect::no_material || m < model.materials.size());
        const trisect::CornerProperties& p = part.properties;
        require(p.values.size() == p.width * part.mesh.corners.size());
        std::size_t width = 0;
        for (const auto& channel : p.channels) width += channel.width;
        require(width == p.width);
        for (const double x : p.values) require(!std::isinf(x));
    }
    for (const auto& m : model.materials)
        require(m.texture == trisect::no_texture || m.texture < model.textures.size());
}

std::size_t faces_of(const Model& model) {
    std::size_t faces = 0;
    for (const ModelPart& part : model.parts) faces += part.mesh.face_count();
    return faces;
}

bool has_only_triangles(const Model& model) {
    for (const ModelPart& part : model.parts)
        for (std::size_t f = 0; f < part.mesh.face_count(); ++f)
            if (part.mesh.face(f).size() != 3) return false;
    return true;
}

/// What a format does not hold may be refused by its writer, but what it wrote is read.
void check_written(const Model& model, MeshFormat format, const trisect::ReadOptions& options) {
    if (trisect::holds_models(format) && !has_only_triangles(model)) return;
    std::string bytes;
    try {
        bytes = trisect::format_model(model, {.format = format, .properties = true}, "a").bytes;
    } catch (const trisect::LimitError&) {
        return;  // beyond the range of floats
    }
    try {
        const Model again = trisect::read_model(bytes, format, "again", options);
        check_invariants(again);
        require(faces_of(again) == faces_of(model));
    } catch (const trisect::LimitError&) {
        // Lines of text and names may have grown.
    } catch (const trisect::Error&) {
        std::abort();
    }
}

void check(std::string_view bytes, MeshFormat format, trisect::ReadOptions options) {
    const Model plain = trisect::read_model(bytes, format, "fuzz", options);
    options.properties = true;
    const Model model = trisect::read_model(bytes, format, "fuzz", options);
    check_invariants(model);
    require(model.parts.size() == plain.parts.size());
    for (std::size_t i = 0; i < model.parts.size(); ++i)
        require(model.parts[i].mesh == plain.parts[i].mesh);
    for (const MeshFormat other :
         {MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Glb, MeshFormat::ThreeMf})
        check_written(model, other, options);
}

void check_library(std::string_view bytes, const trisect::ReadOptions& options) {
    std::vector<std::string> remarks;
    trisect::detail::BesideFiles files(options, remarks);
    std::map<std::string, trisect::detail::LibraryMaterial> materials;
    trisect::detail::read_material_library(bytes, "fuzz", options.limits, files, materials);
}

constexpr const char* relations =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Id=\"a\" Target=\"/a\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const char* const only = std::getenv("TRISECT_FUZZ_FORMAT");
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto choice = (only != nullptr ? std::strtoul(only, nullptr, 10) : data[0]) % 5;
    trisect::ReadOptions options;
    options.limits.vertices = 20'000;
    options.limits.faces = 20'000;
    options.limits.instances = 200;
    options.limits.nesting = 16;
    options.limits.unpacked_bytes = 1 << 20;
    options.limits.property_numbers = 1 << 20;
    try {
        if (choice == 0) check(bytes, MeshFormat::Obj, options);
        if (choice == 1) check(bytes, MeshFormat::Ply, options);
        if (choice == 2) check(bytes, MeshFormat::Glb, options);
        if (choice == 3)
            check(
                trisect::detail::zip_bytes(
                    {{"_rels/.rels", relations}, {"a", std::string(bytes)}, {"p.png", "\x89PNG"}}),
                MeshFormat::ThreeMf, options);
        if (choice == 4) check_library(bytes, options);
    } catch (const trisect::Error&) {
    }
    return 0;
}
