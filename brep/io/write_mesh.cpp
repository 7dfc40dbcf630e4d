// SPDX-License-Identifier: Apache-2.0
//
// From a mesh or model to bytes to a file. Meshes are checked once, here, so that no writer can
// index out of range and nothing is written that the readers would refuse.
#include <trisect/brep/io/write_mesh.h>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/models/models.h>
#include <trisect/brep/io/output_file.h>
#include <trisect/brep/io/properties/mesh_properties.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>

namespace trisect {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& message) {
    throw UsageError(name + ": cannot write: " + message);
}

void check_points(const PolygonMesh& mesh, const std::string& name) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        for (const double c : mesh.points[v]) {
            if (!std::isfinite(c)) {
                refuse(name,
                       "vertex " + std::to_string(v) + " has a coordinate that is not finite");
            }
        }
    }
}

void check_faces(const PolygonMesh& mesh, const std::string& name) {
    const auto& begin = mesh.face_begin;
    if (begin.empty() || begin.front() != 0 || begin.back() != mesh.corners.size()) {
        refuse(name, "the faces do not span the corners");
    }
    for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
        if (begin[f + 1] < begin[f] || begin[f + 1] - begin[f] < 3) {
            refuse(name, "face " + std::to_string(f) + " has fewer than three corners");
        }
        if (begin[f + 1] > mesh.corners.size()) refuse(name, "face beyond the corners");
    }
    for (const std::uint32_t corner : mesh.corners) {
        if (corner >= mesh.points.size()) {
            refuse(name, "a corner names vertex " + std::to_string(corner) + " of " +
                             std::to_string(mesh.points.size()));
        }
    }
}

void check_triangles(const PolygonMesh& mesh, const std::string& name, const std::string& format) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() != 3) {
            throw UnsupportedError(name + ": " + format + " holds triangles only; face " +
                                   std::to_string(f) + " has " +
                                   std::to_string(mesh.face(f).size()) +
                                   " corners (triangulate the mesh first)");
        }
    }
}

void check_materials(const Model& model, const std::string& name) {
    for (const ModelPart& part : model.parts) {
        if (!part.materials.empty() && part.materials.size() != part.mesh.face_count())
            refuse(name, "a part has not as many materials as faces");
        for (const std::uint32_t m : part.materials) {
            if (m != no_material && m >= model.materials.size())
                refuse(name, "a face names material " + std::to_string(m) + " of " +
                                 std::to_string(model.materials.size()));
        }
    }
}

/// The formats that name units have few of them, and not the same names.
std::string unit_for(const Model& model, MeshFormat format, const std::string& name) {
    std::string unit = model.unit.empty() ? "millimeter" : model.unit;
    const bool is_amf = format == MeshFormat::Amf;
    if (unit == "foot" || unit == "feet") unit = is_amf ? "feet" : "foot";
    const bool is_known = unit == "micron" || unit == "millimeter" ||
                          (unit == "centimeter" && !is_amf) || unit == "meter" || unit == "inch" ||
                          unit == "foot" || unit == "feet";
    if (!is_known)
        throw UnsupportedError(name + ": cannot write: " + (is_amf ? "AMF" : "3MF") +
                               " has no unit " + unit + ", and nothing is scaled");
    return unit;
}

std::string title_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::ThreeMf:
            return "3MF";
        case MeshFormat::Amf:
            return "AMF";
        case MeshFormat::Step:
            return "STEP";
        case MeshFormat::Dxf:
            return "DXF";
        default:
            return "GLB";
    }
}

std::size_t width_of(PropertyMeaning meaning) {
    switch (meaning) {
        case PropertyMeaning::TextureCoordinates:
            return 2;
        case PropertyMeaning::Normal:
            return 3;
        default:
            return 4;
    }
}

void check_properties(const Model& model, const std::string& name) {
    for (const ModelPart& part : model.parts) {
        const CornerProperties& properties = part.properties;
        std::size_t width = 0;
        for (const PropertyChannel& channel : properties.channels) {
            const bool is_known = channel.meaning == PropertyMeaning::Any ||
                                  channel.width == width_of(channel.meaning);
            if (!is_known) refuse(name, "properties " + channel.name + " have not their width");
            width += channel.width;
        }
        if (properties.width != 0 && (width != properties.width ||
                                      properties.values.size() != width * part.mesh.corners.size()))
            refuse(name, "properties do not fit their mesh or their channels");
        if (std::any_of(properties.values.begin(), properties.values.end(),
                        [](double x) { return std::isinf(x); }))
            refuse(name, "a property that is not finite");
    }
    for (const ModelMaterial& material : model.materials)
        if (material.texture != no_texture && material.texture >= model.textures.size())
            refuse(name, "a material names texture " + std::to_string(material.texture) + " of " +
                             std::to_string(model.textures.size()));
}

/// The model as formats without properties get it.
Model without_properties(Model model) {
    for (ModelPart& part : model.parts) part.properties = CornerProperties();
    for (ModelMaterial& material : model.materials) material.texture = no_texture;
    model.textures.clear();
    return model;
}

bool has_properties(const Model& model) {
    return !model.textures.empty() ||
           std::any_of(model.parts.begin(), model.parts.end(),
                       [](const ModelPart& part) { return part.properties.width != 0; });
}

/// Properties that GLB and 3MF do not have.
void note_left_out(const Model& model, MeshFormat format, WriteReport& report) {
    const bool is_three_mf = format == MeshFormat::ThreeMf;
    bool lacks_picture = false;
    for (const ModelPart& part : model.parts) {
        for (const PropertyChannel& channel : part.properties.channels) {
            const bool is_normal = channel.meaning == PropertyMeaning::Normal;
            if (channel.meaning != PropertyMeaning::Any && !(is_three_mf && is_normal)) continue;
            report.left_out.push_back(title_of(format) + " has no property " + channel.name);
        }
        const bool has_uv =
            part.properties.column_of(PropertyMeaning::TextureCoordinates).has_value();
        for (std::size_t f = 0; has_uv && is_three_mf && f < part.mesh.face_count(); ++f) {
            const std::uint32_t m = part.materials.empty() ? no_material : part.materials[f];
            const std::uint32_t t = m == no_material ? no_texture : model.materials[m].texture;
            lacks_picture = lacks_picture || t == no_texture || model.textures[t].bytes.empty();
        }
    }
    if (lacks_picture)
        report.left_out.emplace_back("3MF has no texture coordinates where there is no picture");
    std::sort(report.left_out.begin(), report.left_out.end());
    report.left_out.erase(std::unique(report.left_out.begin(), report.left_out.end()),
                          report.left_out.end());
}

FormattedMesh format_parts(const Model& model, MeshFormat format, const std::string& name) {
    check_materials(model, name);
    check_properties(model, name);
    const std::string title = title_of(format);
    if (format == MeshFormat::Dxf) throw UnsupportedError(name + ": DXF is read, not written");
    for (const ModelPart& part : model.parts) {
        check_points(part.mesh, name);
        check_faces(part.mesh, name);
        if (holds_triangles_only(format)) check_triangles(part.mesh, name, title);
    }
#ifdef TRISECT_WITH_STEP
    if (format == MeshFormat::Step) return detail::write_step(model, name);
    if (format == MeshFormat::Amf) return detail::write_amf(model, unit_for(model, format, name));
#endif
#if defined(TRISECT_WITH_ZIP) && defined(TRISECT_WITH_EXPAT)
    if (format == MeshFormat::ThreeMf)
        return detail::write_three_mf(model, unit_for(model, format, name));
#endif
#ifdef TRISECT_WITH_JSON
    if (format == MeshFormat::Glb) return detail::write_glb(model, name);
#endif
    throw UnsupportedError(name + ": this build of Trisect was made without what writing " + title +
                           " takes");
}

FormattedMesh format_with_properties(const Model& model, const WriteOptions& options,
                                     const std::string& name) {
    const MeshFormat format = *options.format;
    if (!holds_properties(format))
        throw UnsupportedError(name +
                               ": cannot write: properties of corners and textures go into "
                               "OBJ, PLY, GLB and 3MF");
    FormattedMesh out;
    if (holds_models(format)) {
        out = format_parts(model, format, name);
        note_left_out(model, format, out.report);
        return out;
    }
    check_materials(model, name);
    check_properties(model, name);
    for (const ModelPart& part : model.parts) {
        check_points(part.mesh, name);
        check_faces(part.mesh, name);
    }
    return format == MeshFormat::Obj
               ? detail::write_obj_properties(model, name)
               : detail::write_ply_properties(model, options.ply_encoding, name);
}

WriteOptions with_format(const std::filesystem::path& path, WriteOptions options) {
    if (!options.format) options.format = mesh_format_of_extension(path);
    if (!options.format) {
        refuse(path.string(),
               "the extension tells no format; known are .obj, .stl, .off, .ply, .3mf, .glb, .amf "
               "and .step");
    }
    return options;
}

}  // namespace

FormattedMesh format_mesh(const PolygonMesh& mesh, const WriteOptions& options,
                          const std::string& name) {
    if (!options.format) refuse(name, "no format given");
    const MeshFormat format = *options.format;
    if (holds_models(format)) return format_parts(model_of(mesh), format, name);
    check_points(mesh, name);
    check_faces(mesh, name);
    FormattedMesh result;
    switch (format) {
        case MeshFormat::Obj:
            detail::write_obj(result.bytes, mesh);
            break;
        case MeshFormat::Off:
            detail::write_off(result.bytes, mesh);
            break;
        case MeshFormat::Ply:
            detail::write_ply(result.bytes, mesh, options.ply_encoding);
            break;
        case MeshFormat::StlAscii:
            check_triangles(mesh, name, "STL");
            detail::write_stl_ascii(result.bytes, mesh);
            break;
        default:
            check_triangles(mesh, name, "STL");
            result.report = detail::write_stl_binary(result.bytes, mesh, name);
            break;
    }
    return result;
}

FormattedMesh format_model(const Model& model, const WriteOptions& options,
                           const std::string& name) {
    if (!options.format) refuse(name, "no format given");
    if (options.properties) return format_with_properties(model, options, name);
    if (holds_models(*options.format))
        return format_parts(has_properties(model) ? without_properties(model) : model,
                            *options.format, name);
    return format_mesh(model.parts.size() == 1 ? model.parts.front().mesh : merged(model), options,
                       name);
}

std::vector<std::vector<std::uint32_t>> faces_off_planes(const Model& model) {
    for (const ModelPart& part : model.parts) {
        check_points(part.mesh, "model");
        check_faces(part.mesh, "model");
    }
#ifdef TRISECT_WITH_STEP
    return detail::faces_off_planes_of(model);
#else
    return std::vector<std::vector<std::uint32_t>>(model.parts.size());
#endif
}

WriteReport write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                       const WriteOptions& options) {
    const FormattedMesh formatted = format_mesh(mesh, with_format(path, options), path.string());
    write_file(path, formatted.bytes);
    return formatted.report;
}

bool holds_properties(MeshFormat format) noexcept {
    return format == MeshFormat::Obj || format == MeshFormat::Ply || format == MeshFormat::Glb ||
           format == MeshFormat::ThreeMf;
}

void refer_to_pictures_in(Model& model, const std::filesystem::path& folder) {
    for (ModelTexture& texture : model.textures) {
        const std::filesystem::path name = texture.file;
        if (texture.file.empty() || texture.bytes.empty() || name.has_parent_path()) continue;
        std::error_code error;
        const std::filesystem::path path = folder / name;
        if (!std::filesystem::is_regular_file(path, error) ||
            std::filesystem::file_size(path, error) != texture.bytes.size())
            continue;
        if (read_file(path, texture.bytes.size()).view() == texture.bytes) texture.bytes.clear();
    }
}

WriteReport write_model(const std::filesystem::path& path, const Model& model,
                        const WriteOptions& options) {
    const WriteOptions known = with_format(path, options);
    FormattedMesh formatted;
    if (known.properties && !holds_models(*known.format)) {
        Model beside = model;
        refer_to_pictures_in(beside, path.parent_path());
        formatted = format_model(beside, known, path.string());
    } else {
        formatted = format_model(model, known, path.string());
    }
    for (const SideFile& file : formatted.files)
        write_file(path.parent_path() / file.name, file.bytes);
    write_file(path, formatted.bytes);
    return formatted.report;
}

}  // namespace trisect
