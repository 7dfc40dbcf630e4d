// SPDX-License-Identifier: Apache-2.0
//
// OBJ: what is read, each documented leniency, each refusal with its place.
#include <trisect/brep/io/formats/decimal.h>

#include "support/mesh_files.h"

#include <cmath>
#include <limits>
#include <string>
#include <system_error>

namespace {

using namespace trisect;
using namespace trisect::io_test;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonMesh obj(const std::string& text) { return read(text, MeshFormat::Obj); }

void expect_obj_error(const std::string& text, const std::string& place, const std::string& part) {
    expect_error_at(text, MeshFormat::Obj, place, part);
}

TEST(Obj, PolygonsAndNumbers) {
    const PolygonMesh m = obj("v 0.1 -2.5e-3 +7\nv 1. .5 1E2\nv 3 4 5\nv 0 0 1e-400\nf 1 2 3 4\n");
    ASSERT_EQ(m.points.size(), 4U);
    EXPECT_EQ(m.points[0], (Point3d{0.1, -2.5e-3, 7}));
    EXPECT_EQ(m.points[1], (Point3d{1, 0.5, 100}));
    EXPECT_EQ(m.points[3], (Point3d{0, 0, 0}));
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2, 3}}));
}

TEST(Obj, NumbersAtTheEndsOfTheRange) {
    const std::string zeros(400, '0');
    const PolygonMesh m = obj("v -1e-99999999999999999999 0e999999999999 0." + zeros + "1\n" +
                              "v 1" + zeros + "e-400 4e-324 -1.7976931348623157e308\n");
    EXPECT_TRUE(std::signbit(m.points[0][0]));
    EXPECT_EQ(m.points[0], (Point3d{0, 0, 0}));
    EXPECT_EQ(m.points[1], (Point3d{1, 4.9406564584124654e-324, -1.7976931348623157e308}));
    expect_obj_error("v 1" + zeros + "e-5 0 0\n", ":1:3", "too large");
    expect_obj_error("v 0 1e+999999999999999999999999 0\n", ":1:5", "too large");
}

TEST(NearestDouble, RoundsAtTheEndsOfTheRange) {
    using trisect::detail::nearest_double;
    const auto read = [](const std::string& text) {
        double value = 7;
        const auto [end, error] = nearest_double(text.data(), text.data() + text.size(), value);
        EXPECT_EQ(end, text.data() + text.size()) << text;
        EXPECT_EQ(error, std::errc{}) << text;
        return value;
    };
    constexpr double least = 4.9406564584124654e-324;
    EXPECT_EQ(read("1e-400"), 0);
    EXPECT_TRUE(std::signbit(read("-1e-400")));
    EXPECT_EQ(read("0.0001e-999999999999999999999"), 0);
    // Half of the least double is 2^-1075: what is below goes to zero.
    EXPECT_EQ(read("2.47032822920623e-324"), 0);
    EXPECT_EQ(read("2.4703282292062328e-324"), least);
    EXPECT_EQ(read("7.4e-324"), least);
    EXPECT_EQ(read("7.5e-324"), 2 * least);
    EXPECT_EQ(read("2.2250738585072011e-308"), std::numeric_limits<double>::min() - least);
    EXPECT_EQ(read("1.7976931348623158e308"), std::numeric_limits<double>::max());
    for (const std::string text : {"1e400", "-1e400", "1.8e308", "0.1e99999999999999999999"}) {
        double value = 7;
        EXPECT_EQ(nearest_double(text.data(), text.data() + text.size(), value).ec,
                  std::errc::result_out_of_range)
            << text;
        EXPECT_EQ(value, 7);
    }
}

TEST(Obj, CornersWithTextureAndNormal) {
    const PolygonMesh m = obj(square + "vt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1 4//\nf 1/ 2 -1/-1/-1\n");
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2, 3}, {0, 1, 3}}));
}

TEST(Obj, NegativeIndicesCountFromTheVerticesSoFar) {
    const PolygonMesh m = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 2 2 2\nf -1 -2 -4\n");
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}, {3, 2, 0}}));
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
    EXPECT_EQ(loops(obj("f 1 2 3\n" + square)), (Loops{{0, 1, 2}}));
    expect_obj_error("f 1 2 3\nf 1 5 4\n" + square, ":2:5", "vertex 5 (counted from 1)");
}

TEST(Obj, ContinuationLines) {
    EXPECT_EQ(loops(obj(square + "f 1 2 \\\n 3 \\\r\n4\n")), (Loops{{0, 1, 2, 3}}));
    EXPECT_EQ(loops(obj("v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1\\\n 2 3")), (Loops{{0, 1, 2}}));
}

TEST(Obj, BackslashInCommentsAndNamesDoesNotSwallowTheNextLine) {
    const PolygonMesh m =
        obj("# C:\\models\\\n" + square + "mtllib D:\\\nf 1 2 3\nl 1 2 \\\n3 4\n");
    EXPECT_EQ(m.points.size(), 4U);
    EXPECT_EQ(m.face_count(), 1U);
}

TEST(Obj, OtherStatementsAreIgnored) {
    const PolygonMesh m =
        obj("mtllib a.mtl\no thing\ng a b\ns off\nusemtl x\n" + square +
            "p 1\nl 1 2\nvp 1 2\nf 1 2 3 # comment\nl 1 99\ncurv2 1 2\n  \n\t#\n");
    EXPECT_EQ(m.points.size(), 4U);
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}}));
}

TEST(Obj, WeightAndColourAfterTheCoordinates) {
    const PolygonMesh m = obj("v 1 2 3 1\nv 1 2 3 0.5 0.5 nan\nv 1 2 3 1 .1 .2 .3\n");
    for (const Point3d& p : m.points) EXPECT_EQ(p, (Point3d{1, 2, 3}));
    expect_obj_error("v 1 2 3 4 5\n", ":1:1", "5 numbers");
    expect_obj_error("v 1 2 3 v 4 5 6\n", ":1:9", "'v'");
}

TEST(Obj, LineEndsAndByteOrderMark) {
    const PolygonMesh expected = obj(square + "f 1 2 3\n");
    for (const std::string eol : {"\r\n", "\r"}) {
        std::string text = "\xEF\xBB\xBF";
        for (const char c : square + "f 1 2 3\n") text += c == '\n' ? eol : std::string(1, c);
        EXPECT_EQ(obj(text), expected);
    }
    EXPECT_EQ(obj("\xEF\xBB\xBF" + square + "f 1 2 3"), expected);
}

TEST(Obj, RepeatedCornersAndUnusedVerticesStay) {
    EXPECT_EQ(loops(obj(square + "f 1 1 2 2\n")), (Loops{{0, 0, 1, 1}}));
    EXPECT_EQ(obj(square).points.size(), 4U);
}

TEST(Obj, EmptyMeshAndOtherText) {
    EXPECT_EQ(obj("# nothing\n\no name\n"), PolygonMesh{});
    expect_obj_error("o name\nThis is a letter.\n", ":2:1", "OBJ does not have");
    expect_obj_error("\x89PNG\r\n", ":1:1", "does not begin");
    expect_obj_error("", ":1:1", "the file is empty");
}

TEST(Obj, BadIndices) {
    expect_obj_error(square + "f 0 1 2\n", ":5:3", "vertex index 0");
    expect_obj_error(square + "f 1 2 5\n", ":5:7", "vertex 5");
    expect_obj_error(square + "f 1 -5 2\n", ":5:5", "reaches back");
    expect_obj_error("f -4 -3 -2\n" + square, ":1:3", "reaches back");
    expect_obj_error(square + "f 1 2 2147483648\n", ":5:7", "2147483648");
    expect_obj_error(square + "f 1 2 4294967297\n", ":5:7", "4294967297");
    expect_obj_error(square + "f 1 2 9223372036854775807\n", ":5:7", "9223372036854775807");
    expect_obj_error(square + "f 1 2 9223372036854775808\n", ":5:7", "too large");
    expect_obj_error(square + "f 1 2 -9223372036854775808\n", ":5:7", "reaches back");
}

TEST(Obj, BadFaces) {
    expect_obj_error(square + "f 1 2\n", ":5:1", "2 corners");
    expect_obj_error(square + "  f\n", ":5:1", "0 corners");
    expect_obj_error(square + "f 1 2 x\n", ":5:7", "'x'");
    expect_obj_error(square + "f 1 2 3.5\n", ":5:7", "malformed");
    expect_obj_error(square + "f 1 2/1/1/1 3\n", ":5:5", "malformed");
    expect_obj_error(square + "f 1 2/a 3\n", ":5:7", "");
    expect_obj_error(square + "f 1 2 3;\n", ":5:7", "malformed");
}

TEST(Obj, BadNumbers) {
    expect_obj_error("v 1 2\n", ":1:6", "ends where");
    expect_obj_error("v 1 2 nan\n", ":1:7", "not finite");
    expect_obj_error("v 1 -inf 2\n", ":1:5", "not finite");
    expect_obj_error("v 1e999 2 3\n", ":1:3", "too large");
    expect_obj_error("v 1 2 3x\n", ":1:7", "not a number");
    expect_obj_error("v 1,5 2 3\n", ":1:3", "not a number");
    expect_obj_error("v 0x10 2 3\n", ":1:3", "not a number");
    expect_obj_error("v 1 2 +-3\n", ":1:7", "not a number");
    expect_obj_error("v 1 2 1e\n", ":1:7", "not a number");
    expect_obj_error(std::string("v 1 2 3\0\n", 9), ":1:7", "not a number");
}

}  // namespace
