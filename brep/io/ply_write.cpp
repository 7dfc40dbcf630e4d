// SPDX-License-Identifier: Apache-2.0
//
// Writing PLY: doubles, so nothing is lost, and the types of lists that most readers know: a count
// of one byte while every face has at most 255 corners, signed indices while they suffice.
#include <trisect/brep/io/detail/binary.h>
#include <trisect/brep/io/detail/formats.h>
#include <trisect/brep/io/detail/number_text.h>

#include <algorithm>
#include <cstdint>

namespace trisect::detail {
namespace {

bool small_faces(const PolygonMesh& mesh) noexcept {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() > 255) return false;
    }
    return true;
}

void write_header(std::string& out, const PolygonMesh& mesh, PlyEncoding encoding) {
    out += "ply\nformat ";
    switch (encoding) {
        case PlyEncoding::Ascii:
            out += "ascii";
            break;
        case PlyEncoding::BinaryLittleEndian:
            out += "binary_little_endian";
            break;
        case PlyEncoding::BinaryBigEndian:
            out += "binary_big_endian";
            break;
    }
    out += " 1.0\ncomment Trisect\nelement vertex ";
    append_integer(out, mesh.points.size());
    out += "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
    append_integer(out, mesh.face_count());
    out += small_faces(mesh) ? "\nproperty list uchar " : "\nproperty list uint ";
    out += mesh.points.size() <= 0x8000'0000U ? "int" : "uint";
    out += " vertex_indices\nend_header\n";
}

void write_text(std::string& out, const PolygonMesh& mesh) {
    for (const Point3d& p : mesh.points) {
        append_point(out, p);
        out += '\n';
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        append_integer(out, mesh.face(f).size());
        for (const std::uint32_t corner : mesh.face(f)) {
            out += ' ';
            append_integer(out, corner);
        }
        out += '\n';
    }
}

void write_bytes(std::string& out, const PolygonMesh& mesh, bool big) {
    const bool small = small_faces(mesh);
    out.reserve(out.size() + 24 * mesh.points.size() + 4 * mesh.corners.size() +
                (small ? 1 : 4) * mesh.face_count());
    for (const Point3d& p : mesh.points) {
        for (const double c : p) store(out, c, big);
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        if (small)
            store(out, static_cast<std::uint8_t>(loop.size()), big);
        else
            store(out, static_cast<std::uint32_t>(loop.size()), big);
        for (const std::uint32_t corner : loop) store(out, corner, big);
    }
}

}  // namespace

void write_ply(std::string& out, const PolygonMesh& mesh, PlyEncoding encoding) {
    write_header(out, mesh, encoding);
    if (encoding == PlyEncoding::Ascii)
        write_text(out, mesh);
    else
        write_bytes(out, mesh, encoding == PlyEncoding::BinaryBigEndian);
}

}  // namespace trisect::detail
