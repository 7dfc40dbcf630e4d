// SPDX-License-Identifier: Apache-2.0
//
// Meshes read in pieces are those that are read as a whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::MeshFormat;
using trisect::PolygonMesh;
using trisect::WriteOptions;

class Collected final : public trisect::MeshSink {
public:
    void take(const PolygonMesh& piece) override {
        ++pieces;
        largest = std::max(largest, piece.points.size() + piece.face_count());
        mesh.points.insert(mesh.points.end(), piece.points.begin(), piece.points.end());
        for (std::size_t f = 0; f < piece.face_count(); ++f) mesh.add_face(piece.face(f));
    }
    PolygonMesh mesh;
    std::size_t pieces = 0;
    std::size_t largest = 0;
};

// The points of all corners: STL has no others.
std::vector<trisect::Point3d> soup(const PolygonMesh& mesh) {
    std::vector<trisect::Point3d> out;
    for (const std::uint32_t corner : mesh.corners) out.push_back(mesh.points[corner]);
    return out;
}

PolygonMesh with_polygons() {
    PolygonMesh out = trisect::make_icosphere(40, 6);  // 81,920 triangles
    const auto n = static_cast<std::uint32_t>(out.points.size());
    for (std::uint32_t i = 0; i < 5; ++i) out.points.push_back({50.0 + i, 0.5 * i * i, 0});
    out.add_face(std::vector<std::uint32_t>{n, n + 1, n + 2, n + 3, n + 4});
    return out;
}

TEST(ReadInPieces, IsTheWholeMesh) {
    struct Case {
        MeshFormat format;
        trisect::PlyEncoding ply;
    };
    for (const Case& c : {Case{MeshFormat::Obj, {}}, Case{MeshFormat::Off, {}},
                          Case{MeshFormat::Ply, trisect::PlyEncoding::Ascii},
                          Case{MeshFormat::Ply, trisect::PlyEncoding::BinaryLittleEndian},
                          Case{MeshFormat::Ply, trisect::PlyEncoding::BinaryBigEndian},
                          Case{MeshFormat::StlAscii, {}}, Case{MeshFormat::StlBinary, {}}}) {
        WriteOptions options;
        options.format = c.format;
        options.ply_encoding = c.ply;
        const PolygonMesh mesh = trisect::holds_triangles_only(c.format)
                                     ? trisect::make_icosphere(40, 6)
                                     : with_polygons();
        const std::string text = trisect::format_mesh(mesh, options).bytes;
        const PolygonMesh whole = trisect::read_mesh(text, c.format, "whole");
        Collected found;
        trisect::read_mesh_in_pieces(text, c.format, "pieces", found);
        EXPECT_GT(found.pieces, 3U);
        EXPECT_LE(found.largest, std::size_t{1} << 16);
        EXPECT_EQ(found.mesh.face_begin, whole.face_begin);
        EXPECT_EQ(soup(found.mesh), soup(whole));
        if (trisect::holds_triangles_only(c.format)) continue;
        EXPECT_EQ(found.mesh.points, whole.points);
        EXPECT_EQ(found.mesh.corners, whole.corners);
    }
}

TEST(ReadInPieces, FacesMayNamePointsOfLaterPieces) {
    std::string text = "f 40001 -1 1\n";
    EXPECT_THROW(
        {
            Collected none;
            trisect::read_mesh_in_pieces(text, MeshFormat::Obj, "o", none);
        },
        trisect::InputError);
    text = "f 40001 2 1\n";
    for (int i = 0; i < 40000; ++i) text += "v 1 2 3\n";
    Collected found;
    try {
        trisect::read_mesh_in_pieces(text, MeshFormat::Obj, "o", found);
        FAIL();
    } catch (const trisect::InputError& e) {
        EXPECT_NE(std::string(e.what()).find("o:1:3: vertex 40001"), std::string::npos) << e.what();
    }
    text += "v 4 5 6\n";
    Collected well;
    trisect::read_mesh_in_pieces(text, MeshFormat::Obj, "o", well);
    EXPECT_EQ(well.mesh.corners, (std::vector<std::uint32_t>{40000, 1, 0}));
}

TEST(ReadInPieces, OtherFormatsAreNot) {
    Collected none;
    EXPECT_FALSE(trisect::is_read_in_pieces(MeshFormat::Glb));
    EXPECT_THROW(trisect::read_mesh_in_pieces("glTF", MeshFormat::Glb, "g", none),
                 trisect::UnsupportedError);
}

}  // namespace
