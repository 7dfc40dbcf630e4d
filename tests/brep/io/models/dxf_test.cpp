// SPDX-License-Identifier: Apache-2.0
//
// DXF: faces and meshes of three dimensions, blocks, and what is refused.
#include "model_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat dxf_format = MeshFormat::Dxf;

/// Words of pairs to lines.
std::string lines(const std::string& words) {
    std::string out;
    for (const char c : words) out += c == ' ' ? '\n' : c;
    return out + "\n";
}

std::string dxf_file(const std::string& entities, const std::string& blocks = "",
                     const std::string& header = "") {
    std::string out;
    if (!header.empty()) out += lines("0 SECTION 2 HEADER") + lines(header) + lines("0 ENDSEC");
    if (!blocks.empty()) out += lines("0 SECTION 2 BLOCKS") + lines(blocks) + lines("0 ENDSEC");
    return out + lines("0 SECTION 2 ENTITIES") + (entities.empty() ? "" : lines(entities)) +
           lines("0 ENDSEC 0 EOF");
}

const std::string dxf_triangle =
    "0 3DFACE 8 wall 10 0 20 0 30 0 11 1 21 0 31 0 12 0 22 1.5 32 0 13 0 23 1.5 33 0";
const std::string dxf_square = "0 3DFACE 8 wall 10 0 20 0 11 1 21 0 12 1 22 1 13 0 23 1";

TEST(Dxf, Faces) {
    const Model model =
        model_in(dxf_file(dxf_triangle + " 0 LINE 10 3 20 3 " + dxf_square, "", "9 $INSUNITS 70 1"),
                 dxf_format);
    EXPECT_EQ(model.unit, "inch");
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].name, "wall");
    const PolygonMesh& mesh = model.parts[0].mesh;
    ASSERT_EQ(mesh.face_count(), 2U);
    EXPECT_EQ(mesh.face(0).size(), 3U);
    EXPECT_EQ(mesh.face(1).size(), 4U);
    EXPECT_EQ(mesh.points.size(), 5U);
    EXPECT_EQ(mesh.points[2], (Point3d{0, 1.5, 0}));
}

TEST(Dxf, Polyface) {
    const std::string vertex = " 0 VERTEX 70 192 10 ";
    const std::string text = dxf_file(
        "0 POLYLINE 8 a 66 1 70 64 71 4 72 1" + vertex + "0 20 0 30 0" + vertex + "1 20 0 30 0" +
        vertex + "1 20 1 30 0" + vertex +
        "0 20 1 30 0 0 VERTEX 70 128 71 1 72 -2 73 3 0 VERTEX 70 128 71 1 72 3 73 4 0 SEQEND");
    const Model model = model_in(text, dxf_format);
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    std::string wrong = text;
    wrong.replace(wrong.find("73\n4"), 4, "73\n5");
    expect_refused<InputError>(wrong, dxf_format, "test:", "vertex 5");
}

TEST(Dxf, PolygonMesh) {
    std::string entities = "0 POLYLINE 70 17 71 3 72 2";
    for (const char* p :
         {"0 20 0 30 0", "0 20 0 30 1", "1 20 0 30 0", "1 20 0 30 1", "0 20 1 30 0", "0 20 1 30 1"})
        entities += std::string(" 0 VERTEX 70 64 10 ") + p;
    const Model model = model_in(dxf_file(entities + " 0 SEQEND"), dxf_format);
    const PolygonMesh& mesh = model.parts.at(0).mesh;
    ASSERT_EQ(mesh.face_count(), 3U);  // closed in one direction
    EXPECT_EQ(std::vector<std::uint32_t>(mesh.face(2).begin(), mesh.face(2).end()),
              (std::vector<std::uint32_t>{4, 0, 1, 5}));
    expect_refused<InputError>(dxf_file(entities + " 0 VERTEX 10 1 20 1 0 SEQEND"), dxf_format,
                               "test:", "3 by 2 has 7 vertices");
}

TEST(Dxf, Mesh) {
    const std::string head = "0 MESH 8 m 71 2 72 0 91 ";
    const std::string body =
        " 92 3 10 0 20 0 30 0 10 1 20 0 30 0 10 0 20 1 30 0 93 4 90 3 90 0 90 1 90 2 94 0 95 0";
    const Model model = model_in(dxf_file(head + "0" + body), dxf_format);
    EXPECT_EQ(model.parts.at(0).mesh.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    expect_refused<UnsupportedError>(dxf_file(head + "2" + body), dxf_format,
                                     "test:", "2 levels of subdivision");
    expect_refused<InputError>(dxf_file(head + "0" + body.substr(0, body.find(" 90 2"))),
                               dxf_format, "test:", "fewer corners");
}

TEST(Dxf, Blocks) {
    const std::string block = "0 BLOCK 2 b 10 1 20 0 30 0 " + dxf_triangle + " 0 ENDBLK";
    const Model model =
        model_in(dxf_file("0 INSERT 2 b 10 5 20 0 30 0 42 2 50 90 0 INSERT 2 b 70 3 44 10", block),
                 dxf_format);
    ASSERT_EQ(model.parts.size(), 4U);
    EXPECT_EQ(model.parts[0].name, "b");
    // Less the base, y doubled, a quarter turn, moved.
    EXPECT_EQ(model.parts[0].mesh.points,
              (std::vector<Point3d>{{5, -1, 0}, {5, 0, 0}, {2, -1, 0}}));
    EXPECT_EQ(model.parts[3].mesh.points[1], (Point3d{20, 0, 0}));
    expect_refused<InputError>(dxf_file("0 INSERT 2 c"), dxf_format, "test:", "no block 'c'");
    expect_refused<InputError>(dxf_file("0 INSERT 2 b", "0 BLOCK 2 b 0 INSERT 2 b 0 ENDBLK"),
                               dxf_format, "test:", "contains itself");
    expect_refused<UnsupportedError>(dxf_file("0 INSERT 2 b 210 1 220 0 230 0", block), dxf_format,
                                     "test:", "another axis");
    expect_refused<LimitError>(dxf_file("0 INSERT 2 b 70 1000000000 71 1000000000 44 1", block),
                               dxf_format, "test:", "limits");
}

TEST(Dxf, Refused) {
    expect_refused<UnsupportedError>(dxf_file("0 3DSOLID 1 acis " + dxf_triangle), dxf_format,
                                     "test:6", "3DSOLID is not read");
    expect_refused<UnsupportedError>(dxf_file("0 LINE 10 0 20 0"), dxf_format, "test:1",
                                     "no 3DFACE");
    expect_refused<UnsupportedError>("AutoCAD Binary DXF\r\n", dxf_format, "test", "binary form");
    expect_refused<InputError>(dxf_file("0 3DFACE 10 0 20 0 11 1 21 0"), dxf_format,
                               "test:", "all of its corners");
    expect_refused<InputError>(dxf_file("0 3DFACE 10 0 20 1,5"), dxf_format, "test:10:1",
                               "'1,5' of group 20");
    expect_refused<InputError>(dxf_file("0 3DFACE 10 nan"), dxf_format, "test:8:1", "'nan'");
    const std::string whole = dxf_file(dxf_triangle);
    expect_refused<InputError>(whole.substr(0, whole.size() - 6), dxf_format,
                               "test:", "ends before EOF");
    expect_refused<InputError>(whole + "0\n", dxf_format, "test:", "after EOF");
    EXPECT_EQ(detect_mesh_format("999\nmade by\n  0\nSECTION\n"), dxf_format);
    EXPECT_EQ(detect_mesh_format(whole), dxf_format);
    // Faces on paper are no model.
    expect_refused<UnsupportedError>(dxf_file(dxf_triangle + " 67 1"), dxf_format, "test:1",
                                     "no 3DFACE");
}

}  // namespace
