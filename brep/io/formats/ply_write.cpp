// SPDX-License-Identifier: Apache-2.0
//
// Writing PLY: doubles, so nothing is lost, and the types of lists that most readers accept: a
// count of one byte while every face has at most 255 corners, signed indices while they suffice.
#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/number_text.h>

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
    TextWriter text(out);
    text << "ply\nformat ";
    switch (encoding) {
        case PlyEncoding::Ascii:
            text << "ascii";
            break;
        case PlyEncoding::BinaryLittleEndian:
            text << "binary_little_endian";
            break;
        case PlyEncoding::BinaryBigEndian:
            text << "binary_big_endian";
            break;
    }
    text << " 1.0\ncomment Trisect\nelement vertex " << std::uint64_t{mesh.points.size()}
         << "\nproperty double x\nproperty double y\nproperty double z\n"
         << "element face " << std::uint64_t{mesh.face_count()}
         << (small_faces(mesh) ? "\nproperty list uchar " : "\nproperty list uint ")
         << (mesh.points.size() <= 0x8000'0000U ? "int" : "uint")
         << " vertex_indices\nend_header\n";
    text.finish();
}

void write_text(std::string& out, const PolygonMesh& mesh) {
    reserve_text(out, mesh);
    TextWriter text(out);
    for (const Point3d& p : mesh.points) text << p << '\n';
    append_loops(text, mesh);
    text.finish();
}

template <bool Big, class Count>
void write_bytes(std::string& out, const PolygonMesh& mesh) {
    const std::size_t header = out.size();
    out.resize(header + 24 * mesh.points.size() + 4 * mesh.corners.size() +
               sizeof(Count) * mesh.face_count());
    char* to = out.data() + header;
    for (const Point3d& p : mesh.points)
        for (const double c : p) put<Big>(to, c);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        put<Big>(to, static_cast<Count>(loop.size()));
        for (const std::uint32_t corner : loop) put<Big>(to, corner);
    }
}

template <bool Big>
void write_bytes(std::string& out, const PolygonMesh& mesh) {
    if (small_faces(mesh))
        write_bytes<Big, std::uint8_t>(out, mesh);
    else
        write_bytes<Big, std::uint32_t>(out, mesh);
}

}  // namespace

void write_ply(std::string& out, const PolygonMesh& mesh, PlyEncoding encoding) {
    write_header(out, mesh, encoding);
    switch (encoding) {
        case PlyEncoding::Ascii:
            return write_text(out, mesh);
        case PlyEncoding::BinaryLittleEndian:
            return write_bytes<false>(out, mesh);
        case PlyEncoding::BinaryBigEndian:
            return write_bytes<true>(out, mesh);
    }
}

}  // namespace trisect::detail
