// SPDX-License-Identifier: Apache-2.0
//
// STL of both kinds: telling them apart, exact welding, each leniency and each refusal.
#include <trisect/brep/io/formats/binary.h>

#include "support/mesh_files.h"

#include <cmath>
#include <limits>

namespace {

using namespace trisect;
using namespace trisect::io_test;

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
}

const std::string one = facet("0 0 0", "1 0 0", "0 1 0");

PolygonMesh ascii(const std::string& text) { return read(text, MeshFormat::StlAscii); }

std::string binary(std::uint32_t count, const std::vector<float>& values,
                   const std::string& header = "") {
    std::string s = header;
    s.resize(80, ' ');
    detail::store(s, count, false);
    for (std::size_t i = 0; i < values.size(); i += 9) {
        for (int k = 0; k < 3; ++k) detail::store(s, std::nanf(""), false);
        for (std::size_t k = 0; k < 9; ++k) detail::store(s, values[i + k], false);
        s += "ab";
    }
    return s;
}

const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(StlAscii, WeldsEqualCornersInOrderOfAppearance) {
    const PolygonMesh m =
        ascii("solid a\n" + one + facet("0 1 0", "1 0 0", "1.0 1e0 0") + "endsolid a\n");
    EXPECT_EQ(m.points, (std::vector<Point3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}, {2, 1, 3}}));
}

TEST(StlAscii, WeldingIsExactButZeroHasNoSign) {
    const PolygonMesh m = ascii("solid\n" + facet("-0 0 0", "1 0 0", "1.0000000000000002 0 0") +
                                facet("0 -0.0 0", "1 0 -0", "5e-324 0 0") + "endsolid\n");
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}, {0, 1, 3}}));
    EXPECT_TRUE(std::signbit(m.points[0][0]));
}

TEST(StlAscii, FreeForm) {
    const PolygonMesh expected = ascii("solid a\n" + one + "endsolid a\n");
    EXPECT_EQ(ascii("SOLID\nFACET OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0\nVERTEX 0\n1 0 ENDLOOP "
                    "EndFacet EndSolid"),
              expected);
    EXPECT_EQ(ascii("\xEF\xBB\xBF\r\n solid " + std::string(5000, 'x') +
                    "\r\nfacet normal nan 0 x "
                    "outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\r\n"
                    "endsolid a b c\r\n\r\n"),
              expected);
    EXPECT_EQ(
        ascii("solid a\n" + one + "endsolid a\nsolid b\n" + one + "endsolid b\n").face_count(), 2U);
    EXPECT_EQ(ascii("solid Empty\nendsolid Empty"), PolygonMesh{});
}

TEST(StlAscii, Errors) {
    const auto expect = [](const std::string& text, const std::string& place,
                           const std::string& part) {
        expect_error_at(text, MeshFormat::StlAscii, place, part);
    };
    expect("", ":1:1", "empty");
    expect(" \n", ":2:1", "no 'solid'");
    expect("facet\n", ":1:1", "'solid' is expected");
    expect("solid a\n" + one, ":9:1", "'facet' or 'endsolid'");
    expect("solid a\n" + one + "endsolid\ngarbage\n", ":10:1", "'solid' is expected");
    expect("solid a\nfacet normal 0 0 0 1 outer loop\n", ":2:20", "'outer loop'");
    expect("solid a\nfacet outer loop vertex 0 0 0 vertex 0 0 inf\n", ":2:42", "not finite");
    expect("solid a\nfacet outer loop vertex 0 0 0 vertex 0 0 1 endloop\n", ":2:44", "'vertex'");
    expect("solid a\nfacet outer loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nvertex 1 1 0\n",
           ":6:1", "'endloop' is expected");
    expect("solid a\nfacet outer loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nendloop\nfacet\n",
           ":7:1", "'endfacet' is expected");
}

TEST(StlBinary, ReadsFloatsExactly) {
    const PolygonMesh m =
        read(binary(2, {0.1F, 0, 0, 1e-45F, 3e38F, 0, 0, 1, 0, 0, 1, 0, 0.1F, -0.0F, 0, 7, 8, 9}),
             MeshFormat::StlBinary);
    EXPECT_EQ(m.points[0][0], static_cast<double>(0.1F));
    EXPECT_EQ(m.points[1], (Point3d{static_cast<double>(1e-45F), static_cast<double>(3e38F), 0}));
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}, {2, 0, 3}}));
}

TEST(StlBinary, SizeDecidesAndNotTheWordSolid) {
    const std::string file = binary(1, triangle, "solid made by a careless exporter");
    EXPECT_EQ(detect_stl_kind(file), MeshFormat::StlBinary);
    EXPECT_EQ(read(file, MeshFormat::Stl).face_count(), 1U);
    EXPECT_EQ(detect_stl_kind(file.substr(0, 100)), MeshFormat::StlBinary);
    EXPECT_EQ(detect_stl_kind(file + "\n"), MeshFormat::StlBinary);
    EXPECT_EQ(detect_stl_kind("solid a\n" + one + "endsolid a\n"), MeshFormat::StlAscii);
    EXPECT_EQ(detect_stl_kind("  SOLID\nendsolid"), MeshFormat::StlAscii);
    EXPECT_EQ(detect_stl_kind("nothing"), MeshFormat::StlBinary);
}

TEST(StlBinary, SizesAroundTheHeader) {
    for (const std::size_t n : {1U, 79U, 80U, 83U}) {
        EXPECT_NE(input_error(std::string(n, '\0'), MeshFormat::Stl).find("at least 84 bytes"),
                  std::string::npos);
    }
    EXPECT_EQ(read(std::string(84, '\0'), MeshFormat::Stl), PolygonMesh{});
    EXPECT_EQ(read(std::string(85, '\0'), MeshFormat::Stl), PolygonMesh{});
    expect_error_at("", MeshFormat::StlBinary, ": byte 0", "empty");
}

TEST(StlBinary, Errors) {
    expect_error_at(binary(2, triangle), MeshFormat::Stl, ": byte 134",
                    "2 triangles has 184 bytes");
    expect_error_at(binary(0xFFFFFFFFU, {}), MeshFormat::Stl, ": byte 84", "text");
    expect_error_at(binary(0, triangle), MeshFormat::Stl, ": byte 86", "more data after");
    expect_error_at(binary(1, triangle) + "x", MeshFormat::Stl, ": byte 134", "more data after");
    EXPECT_EQ(
        read(binary(1, triangle) + "\r\n" + std::string(60, '\0'), MeshFormat::Stl).face_count(),
        1U);
    const float inf = std::numeric_limits<float>::infinity();
    expect_error_at(binary(1, {0, 0, 0, 0, 0, inf, 0, 0, 0}), MeshFormat::Stl, ": byte 116",
                    "not finite");
    expect_error_at(binary(1, {std::nanf(""), 0, 0, 0, 0, 0, 0, 0, 0}), MeshFormat::Stl,
                    ": byte 96", "not finite");
}

TEST(StlBinary, WritingReportsWhatFloatsCannotHold) {
    PolygonMesh mesh = tetrahedron();
    EXPECT_EQ(format_mesh(mesh, {.format = MeshFormat::Stl}).report, WriteReport{});
    mesh.points[1][0] = 1 + 0x1p-30;
    mesh.points[2][1] = 1 + 0x1p-24;
    WriteReport report = format_mesh(mesh, {.format = MeshFormat::Stl}).report;
    EXPECT_FALSE(report.lossless);
    EXPECT_EQ(report.rounded_vertices, 2U);
    EXPECT_EQ(report.largest_move, 0x1p-24);
    EXPECT_EQ(report.merged_vertices, 0U);
    mesh.points[3] = {1, 0, 0};
    report = format_mesh(mesh, {.format = MeshFormat::StlBinary}).report;
    EXPECT_EQ(report.merged_vertices, 1U);
    EXPECT_TRUE(format_mesh(mesh, {.format = MeshFormat::StlAscii}).report.lossless);
}

TEST(StlBinary, WritingRefusesWhatItCannotHold) {
    PolygonMesh mesh = tetrahedron();
    mesh.points[0][0] = 1e300;
    EXPECT_THROW((void)format_mesh(mesh, {.format = MeshFormat::Stl}), LimitError);
    EXPECT_NO_THROW((void)format_mesh(mesh, {.format = MeshFormat::StlAscii}));
    PolygonMesh quad = tetrahedron();
    const std::vector<std::uint32_t> loop{0, 1, 2, 3};
    quad.add_face(loop);
    EXPECT_THROW((void)format_mesh(quad, {.format = MeshFormat::Stl}), UnsupportedError);
    EXPECT_THROW((void)format_mesh(quad, {.format = MeshFormat::StlAscii}), UnsupportedError);
}

TEST(Stl, NormalsAreOfUnitLengthOrZero) {
    PolygonMesh mesh = tetrahedron();
    mesh.add_triangle(1, 1, 2);
    const std::string text = format_mesh(mesh, {.format = MeshFormat::StlAscii}).bytes;
    EXPECT_NE(text.find("facet normal 0 0 -1\n"), std::string::npos);
    EXPECT_NE(text.find("facet normal 0.57735026 0.57735026 0.57735026\n"), std::string::npos);
    EXPECT_NE(text.find("facet normal 0 0 0\n"), std::string::npos);
    EXPECT_EQ(read(text, MeshFormat::Stl).face_count(), 5U);
}

}  // namespace
