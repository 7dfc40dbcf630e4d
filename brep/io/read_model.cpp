// SPDX-License-Identifier: Apache-2.0
//
// From a path or bytes to the reader of a format with parts, as far as this build has them.
#include <trisect/brep/io/read_model.h>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/models/models.h>
#include <trisect/brep/io/properties/mesh_properties.h>
#include <trisect/kernel/error.h>

#include <algorithm>

namespace trisect {
namespace {

[[maybe_unused]] [[noreturn]] void lacks(const std::string& name, const char* format,
                                         const char* what) {
    throw UnsupportedError(name + ": this build of Trisect does not read or write " + format +
                           ": it was made without " + what);
}

Model read_parts(std::string_view data, MeshFormat format, const std::string& name,
                 const ReadOptions& options, ModelReport& report) {
    const ReadLimits& limits = options.limits;
    if (data.size() > limits.bytes) {
        throw LimitError(name + ": more than " + std::to_string(limits.bytes) +
                         " bytes, the limit for a file");
    }
    if (data.empty()) throw InputError(FilePlace{name, 0, 0, 0}, "the file is empty");
    report = ModelReport();
    switch (format) {
        case MeshFormat::ThreeMf:
#if defined(TRISECT_WITH_ZIP) && defined(TRISECT_WITH_EXPAT)
            return detail::read_three_mf(data, name, options, report);
#else
            lacks(name, "3MF", "libzip and expat");
#endif
        case MeshFormat::Amf:
#ifdef TRISECT_WITH_EXPAT
            return detail::read_amf(data, name, limits, report);
#else
            lacks(name, "AMF", "expat");
#endif
        case MeshFormat::Step:
#ifdef TRISECT_WITH_STEP
            return detail::read_step(data, name, limits, report);
#else
            lacks(name, "STEP", "all formats");
#endif
        case MeshFormat::Dxf:
#ifdef TRISECT_WITH_STEP
            return detail::read_dxf_model(data, name, limits, report);
#else
            lacks(name, "DXF", "all formats");
#endif
        default:
#ifdef TRISECT_WITH_JSON
            return detail::read_glb(data, name, options, report);
#else
            lacks(name, "GLB", "nlohmann-json");
#endif
    }
}

}  // namespace

bool is_available(MeshFormat format) noexcept {
#if !defined(TRISECT_WITH_ZIP) || !defined(TRISECT_WITH_EXPAT)
    if (format == MeshFormat::ThreeMf) return false;
#endif
#ifndef TRISECT_WITH_EXPAT
    if (format == MeshFormat::Amf) return false;
#endif
#ifndef TRISECT_WITH_JSON
    if (format == MeshFormat::Glb) return false;
#endif
#ifndef TRISECT_WITH_STEP
    if (format == MeshFormat::Step || format == MeshFormat::Dxf) return false;
#endif
    (void)format;
    return true;
}

bool holds_models(MeshFormat format) noexcept {
    switch (format) {
        case MeshFormat::ThreeMf:
        case MeshFormat::Glb:
        case MeshFormat::Amf:
        case MeshFormat::Step:
        case MeshFormat::Dxf:
            return true;
        default:
            return false;
    }
}

Model model_of(PolygonMesh mesh) {
    Model model;
    model.parts.push_back({{}, std::move(mesh), {}});
    return model;
}

ModelPart merged_part(const Model& model) {
    ModelPart out;
    std::vector<PropertyPiece> pieces;
    for (const ModelPart& part : model.parts) {
        out.materials.resize(out.mesh.face_count(), no_material);
        append(out.mesh, part.mesh);
        out.materials.insert(out.materials.end(), part.materials.begin(), part.materials.end());
        pieces.push_back({&part.properties, part.mesh.corners.size()});
    }
    out.materials.resize(out.mesh.face_count(), no_material);
    if (std::all_of(out.materials.begin(), out.materials.end(),
                    [](std::uint32_t m) { return m == no_material; }))
        out.materials.clear();
    if (model.parts.size() == 1) out.name = model.parts.front().name;
    out.properties = joined_properties(pieces);
    return out;
}

PolygonMesh merged(const Model& model) {
    PolygonMesh mesh;
    for (const ModelPart& part : model.parts) append(mesh, part.mesh);
    return mesh;
}

Model read_model(std::string_view data, MeshFormat format, const std::string& name,
                 const ReadOptions& options, ModelReport* report) {
    ModelReport unread;
    ModelReport& made = report != nullptr ? *report : unread;
    if (holds_models(format)) return read_parts(data, format, name, options, made);
    made = ModelReport();
    PolygonMesh mesh = read_mesh(data, format, name, options);
    const bool has_properties = format == MeshFormat::Obj || format == MeshFormat::Ply;
    if (!options.properties || !has_properties) return model_of(std::move(mesh));
    detail::BesideFiles files(options, made.remarks);
    const detail::InputText source(data, name, options.limits, false);
    return format == MeshFormat::Obj ? detail::read_obj_properties(source, std::move(mesh), files)
                                     : detail::read_ply_properties(source, std::move(mesh), files);
}

Model read_model(const std::filesystem::path& path, const ReadOptions& options,
                 ModelReport* report) {
    const FileBytes bytes = read_file(path, options.limits.bytes);
    ReadOptions here = options;
    if (!here.folder) here.folder = path.parent_path();
    return read_model(bytes.view(), mesh_format_of(path, bytes.view(), options), path.string(),
                      here, report);
}

}  // namespace trisect
