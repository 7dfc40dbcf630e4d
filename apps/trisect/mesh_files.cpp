// SPDX-License-Identifier: Apache-2.0
#include "mesh_files.h"

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/whole_faces.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/property_mesh.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "values.h"

namespace trisect::app {
namespace {

constexpr const char* standard_input = "standard input";

/// A file in memory whose format is known.
struct InputFile {
    FileBytes bytes;
    MeshFormat format;
    std::string name;  ///< in messages
};

InputFile standard_input_file(const ReadOptions& options) {
    FileBytes bytes = read_descriptor(0, standard_input, options.limits.bytes);
    std::optional<MeshFormat> format = options.format;
    if (!format) format = detect_mesh_format(bytes.view());
    if (!format) {
        throw InputError(FilePlace{standard_input, 0, 0, 0},
                         bytes.view().empty() ? "there is nothing to read"
                                              : "the content does not tell the format: --format");
    }
    return {std::move(bytes), *format, standard_input};
}

InputFile named_file(const std::string& name, const ReadOptions& options) {
    FileBytes bytes = read_file(name, options.limits.bytes);
    const MeshFormat format = mesh_format_of(name, bytes.view(), options);
    return {std::move(bytes), format, name};
}

ReadOptions read_options(const Session& session, const std::string& name) {
    ReadOptions options;
    options.format = session.options().input_format;
    if (name == "-" && !options.format) options.format = session.options().format;
    return options;
}

InputFile input_file(const Session& session, const std::string& name) {
    const ReadOptions options = read_options(session, name);
    return name == "-" ? standard_input_file(options) : named_file(name, options);
}

/// Errors of the library about one operand, with its name in front.
template <class Work>
auto with_name(const std::string& name, Work&& work) {
    try {
        return work();
    } catch (const InvalidSolid& e) {
        throw OperandError(e.code(), name, e.what(), e.report());
    } catch (const Error& e) {
        throw OperandError(e.code(), name, e.what());
    }
}

bool has_only_triangles(const PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() != 3) return false;
    }
    return true;
}

/// The same surface in triangles: polygons are cut by exact rules on the lattice, which changes no
/// coordinate; where the lattice cannot hold them all, cutting is refused rather than rounding.
ImportedMesh cut_into_triangles(const PolygonMesh& mesh) {
    ImportOptions options;
    options.require_closed = false;
    ImportedMesh imported = import_mesh(mesh, options);
    if (!imported.report.lattice.lossless) {
        throw UnsupportedError(
            "this format holds no such polygons, and the coordinates span too many "
            "bits to cut the polygons of this mesh exactly");
    }
    return imported;
}

PolygonMesh triangulated(const PolygonMesh& mesh) {
    return plain_mesh(cut_into_triangles(mesh).mesh);
}

/// Each triangle has what its polygon has.
void cut_with_properties(ModelPart& part) {
    const LatticeMesh cut = cut_into_triangles(part.mesh).mesh;
    std::vector<FaceSource> source;
    std::vector<std::uint32_t> materials;
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
        source.push_back({0, cut.face_of(t)});
        if (!part.materials.empty()) materials.push_back(part.materials[cut.face_of(t)]);
    }
    PropertyMesh made =
        with_properties(plain_mesh(cut), std::move(source),
                        std::array{PropertyOperand{0, &part.mesh, &part.properties}});
    part.properties = std::move(made.properties);
    part.mesh = std::move(made.mesh);
    part.materials = std::move(materials);
}

/// The mesh with these faces in triangles, which come last, with points of their own.
PolygonMesh with_triangulated(const PolygonMesh& mesh, const std::vector<std::uint32_t>& faces) {
    PolygonMesh cut;
    cut.points = mesh.points;
    PolygonMesh out;
    out.points = mesh.points;
    std::size_t next = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const bool is_cut = next < faces.size() && faces[next] == f;
        next += is_cut ? 1U : 0U;
        (is_cut ? cut : out).add_face(mesh.face(f));
    }
    append(out, triangulated(cut));
    return out;
}

/// STEP has planar faces: the others are cut.
void cut_uneven_faces(Model& model) {
    const auto uneven = faces_off_planes(model);
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
        if (uneven[i].empty()) continue;
        model.parts[i].mesh = with_triangulated(model.parts[i].mesh, uneven[i]);
        model.parts[i].materials.clear();
    }
}

PolygonMesh rounded_mesh_of(const std::string& name) {
    if (has_native_name(name)) return read_native(name).to_mesh();
    return to_polygon_mesh(read_exact(std::filesystem::path(name)));
}

}  // namespace

bool has_exact_boundary(const std::string& name) { return name.ends_with(".exact"); }

bool has_native_name(const std::string& name) { return name.ends_with(".trisect"); }

bool has_lossless_name(const std::string& name) {
    return has_native_name(name) || has_exact_boundary(name);
}

void write_lossless_output(Session& session, const std::string& name, const Solid& solid) {
    if (has_native_name(name))
        session.write_output(name, native_bytes(solid), OutputSafety::Flushed);
    else
        session.write_output(name, exact_text(solid.to_brep()));
}

InputModel read_input_model(const Session& session, const std::string& name, bool properties) {
    InputModel out;
    if (has_lossless_name(name)) {
        out.model = model_of(rounded_mesh_of(name));
        return out;
    }
    const InputFile file = input_file(session, name);
    out.format = file.format;
    ReadOptions options;
    options.properties = properties;
    if (name != "-") options.folder = std::filesystem::path(name).parent_path();
    out.model = read_model(file.bytes.view(), file.format, file.name, options, &out.report);
    return out;
}

PolygonMesh one_mesh(Model&& model) {
    return model.parts.size() == 1 ? std::move(model.parts.front().mesh) : merged(model);
}

Model one_part(Model&& model) {
    Model out = std::move(model);
    if (out.parts.size() == 1) return out;
    ModelPart all = merged_part(out);
    out.parts.clear();
    out.parts.push_back(std::move(all));
    return out;
}

PolygonMesh read_input(const Session& session, const std::string& name) {
    return one_mesh(read_input_model(session, name).model);
}

RemarkedMesh read_input_with_remarks(const Session& session, const std::string& name) {
    if (has_lossless_name(name)) return {rounded_mesh_of(name), {}};
    const InputFile file = input_file(session, name);
    PolygonMesh mesh = read_mesh(file.bytes.view(), file.format, file.name);
    return {std::move(mesh), file_remarks(file.bytes.view(), file.format, file.name)};
}

void check_standard_input(std::span<const std::string> names) {
    if (std::count(names.begin(), names.end(), "-") > 1) {
        throw UsageError("only one input can be the standard input");
    }
}

ImportedMesh import_input(const Session& session, const PolygonMesh& mesh,
                          const std::string& name) {
    ImportOptions options;
    options.require_closed = false;
    options.nonplanar = session.options().nonplanar;
    options.refit_move = session.options().refit_move;
    if (session.options().lattice) options.lattice = Lattice{*session.options().lattice};
    return with_name(name, [&] { return import_mesh(mesh, options); });
}

ValidationReport validate_input(const PolygonMesh& mesh, const std::string& name,
                                const ValidateOptions& options) {
    return with_name(name, [&] { return validate(mesh, options); });
}

void add_properties_option(CLI::App& command, bool& properties) {
    command.add_flag("--properties", properties,
                     "keep materials, textures, texture coordinates, normals and colours of "
                     "corners of OBJ, PLY, GLB and 3MF, in an output of one of these");
}

void check_holds_properties(const std::string& name, MeshFormat format) {
    if (!holds_properties(format))
        throw UnsupportedError(fmt::format(
            "{}: {} holds no properties of corners and no textures; OBJ, PLY, GLB and 3MF do", name,
            to_string(format)));
    if (name == "-" && format == MeshFormat::Obj)
        throw UsageError("OBJ has its materials in a file beside it: not on the standard output");
}

MeshFormat output_format(const Session& session, const std::string& name) {
    const CommonOptions& common = session.options();
    if (name == "-" && common.json) {
        throw UsageError("--json and '-o -' both want the standard output");
    }
    const auto format = common.format ? common.format : mesh_format_of_extension(name);
    if (format == MeshFormat::Dxf) throw UnsupportedError(name + ": DXF is read, not written");
    if (format && !is_available(*format)) {
        throw UnsupportedError(
            fmt::format("{}: this build does not write {}", name, to_string(*format)));
    }
    if (common.format) return *common.format;
    if (name == "-") throw UsageError("'-o -' needs --format");
    if (format) return *format;
    throw UsageError(fmt::format(
        "{}: the extension tells no format; known are .obj .stl .off .ply .3mf .glb .amf "
        ".step (or use --format)",
        name));
}

FormattedMesh format_output_mesh(const std::string& name, MeshFormat format,
                                 const PolygonMesh& mesh) {
    WriteOptions options;
    options.format = format;
    if (format == MeshFormat::Step) return format_output_model(name, format, model_of(mesh));
    const bool cut = holds_triangles_only(format) && !has_only_triangles(mesh);
    return format_mesh(cut ? triangulated(mesh) : mesh, options, name);
}

FormattedMesh format_output_model(const std::string& name, MeshFormat format, Model model,
                                  bool properties) {
    if (!holds_models(format) && !properties)
        return format_output_mesh(name, format, one_mesh(std::move(model)));
    if (format == MeshFormat::Step) cut_uneven_faces(model);
    for (ModelPart& part : model.parts) {
        if (!holds_triangles_only(format) || has_only_triangles(part.mesh)) continue;
        if (properties) {
            cut_with_properties(part);
        } else {
            part.mesh = triangulated(part.mesh);
            part.materials.clear();
        }
    }
    WriteOptions options;
    options.format = format;
    options.properties = properties;
    if (properties && !holds_models(format))
        refer_to_pictures_in(model, std::filesystem::path(name).parent_path());
    return format_model(model, options, name);
}

void note_written(Session& session, const std::string& name, const WriteReport& report) {
    for (const std::string& what : report.left_out)
        session.note(fmt::format("{}: {}; it is left out", name, what));
    if (report.lossless) return;
    session.note(fmt::format("{}: {} vertices rounded to the floats of this format, by at most {}",
                             name, report.rounded_vertices, number_text(report.largest_move)));
}

WriteReport write_output_mesh(Session& session, const std::string& name,
                              const FormattedMesh& formatted) {
    if (name == "-" && !formatted.files.empty())
        throw UsageError("pictures are files beside the output: not on the standard output");
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    for (const SideFile& file : formatted.files)
        session.write_output((folder / file.name).string(), file.bytes);
    session.write_output(name, formatted.bytes);
    note_written(session, name, formatted.report);
    return formatted.report;
}

WriteReport write_output_mesh(Session& session, const std::string& name, MeshFormat format,
                              const PolygonMesh& mesh) {
    return write_output_mesh(session, name, format_output_mesh(name, format, mesh));
}

WriteReport write_output_model(Session& session, const std::string& name, MeshFormat format,
                               Model model, bool properties) {
    return write_output_mesh(session, name,
                             format_output_model(name, format, std::move(model), properties));
}

PolygonMesh output_polygons(const Brep& brep, MeshFormat format, MeshMap* map) {
    return format == MeshFormat::Step ? whole_face_mesh(brep, map) : to_polygon_mesh(brep, {}, map);
}

PolygonMesh plain_mesh(const LatticeMesh& mesh) {
    PolygonMesh out;
    out.points.reserve(mesh.points.size());
    for (const LatticePoint& p : mesh.points) out.points.push_back(to_user(p, mesh.lattice));
    for (const auto& t : mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
    return out;
}

}  // namespace trisect::app
