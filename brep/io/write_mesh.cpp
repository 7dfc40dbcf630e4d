// SPDX-License-Identifier: Apache-2.0
//
// From a mesh to bytes to a file. The mesh is checked once, here, so that no writer can index out
// of range and nothing is written that the readers would refuse.
#include <trisect/brep/io/write_mesh.h>

#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/output_file.h>
#include <trisect/kernel/error.h>

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

void check_triangles(const PolygonMesh& mesh, const std::string& name) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() != 3) {
            throw UnsupportedError(name + ": STL holds triangles only; face " + std::to_string(f) +
                                   " has " + std::to_string(mesh.face(f).size()) +
                                   " corners (triangulate the mesh first)");
        }
    }
}

}  // namespace

FormattedMesh format_mesh(const PolygonMesh& mesh, const WriteOptions& options,
                          const std::string& name) {
    if (!options.format) refuse(name, "no format given");
    const MeshFormat format = *options.format;
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
            check_triangles(mesh, name);
            detail::write_stl_ascii(result.bytes, mesh);
            break;
        case MeshFormat::Stl:
        case MeshFormat::StlBinary:
            check_triangles(mesh, name);
            result.report = detail::write_stl_binary(result.bytes, mesh, name);
            break;
    }
    return result;
}

WriteReport write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                       const WriteOptions& options) {
    WriteOptions chosen = options;
    if (!chosen.format) chosen.format = mesh_format_of_extension(path);
    if (!chosen.format) {
        refuse(path.string(), "the extension tells no format; known are .obj, .stl, .off and .ply");
    }
    const FormattedMesh formatted = format_mesh(mesh, chosen, path.string());
    write_file(path, formatted.bytes);
    return formatted.report;
}

}  // namespace trisect
