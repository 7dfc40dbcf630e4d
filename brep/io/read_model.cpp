// SPDX-License-Identifier: Apache-2.0
//
// From a path or bytes to the reader of a format with parts, as far as this build has them.
#include <trisect/brep/io/read_model.h>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/models/models.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

[[maybe_unused]] [[noreturn]] void lacks(const std::string& name, const char* format,
                                         const char* what) {
    throw UnsupportedError(name + ": this build of Trisect does not read or write " + format +
                           ": it was made without " + what);
}

Model read_parts(std::string_view data, MeshFormat format, const std::string& name,
                 const ReadLimits& limits, ModelReport& report) {
    if (data.size() > limits.bytes) {
        throw LimitError(name + ": more than " + std::to_string(limits.bytes) +
                         " bytes, the limit for a file");
    }
    if (data.empty()) throw InputError(FilePlace{name, 0, 0, 0}, "the file is empty");
    report = ModelReport();
    switch (format) {
        case MeshFormat::ThreeMf:
#if defined(TRISECT_WITH_ZIP) && defined(TRISECT_WITH_EXPAT)
            return detail::read_three_mf(data, name, limits, report);
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
            return detail::read_glb(data, name, limits, report);
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

PolygonMesh merged(const Model& model) {
    PolygonMesh mesh;
    for (const ModelPart& part : model.parts) append(mesh, part.mesh);
    return mesh;
}

Model read_model(std::string_view data, MeshFormat format, const std::string& name,
                 const ReadOptions& options, ModelReport* report) {
    ModelReport unread;
    if (!holds_models(format)) return model_of(read_mesh(data, format, name, options));
    return read_parts(data, format, name, options.limits, report != nullptr ? *report : unread);
}

Model read_model(const std::filesystem::path& path, const ReadOptions& options,
                 ModelReport* report) {
    const FileBytes bytes = read_file(path, options.limits.bytes);
    return read_model(bytes.view(), mesh_format_of(path, bytes.view(), options), path.string(),
                      options, report);
}

}  // namespace trisect
