// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <trisect/brep/io/read_model.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class EvalCommand : public trisect::test::Scratch {
protected:
    std::string model_ = write("m.csg", "difference() { cube(size = 4); cube(size = 2); }\n");
};

TEST_F(EvalCommand, WritesTheSolid) {
    const json document = trisect({"eval", model_, "-o", path("m.off"), "--json"}).json();
    EXPECT_EQ(document["schema"], "trisect.eval/1");
    EXPECT_EQ(document["volume"], 56);
    EXPECT_EQ(trisect({"info", path("m.off"), "--json"}).json()["volume"], 56);
    EXPECT_EQ(trisect({"eval", model_, "-o", path("m.exact")}).code, 0);
    EXPECT_TRUE(exists("m.exact"));
    EXPECT_EQ(trisect({"eval", model_, "-o", path("m.trisect")}).code, 0);
    EXPECT_EQ(trisect({"info", path("m.trisect"), "--json"}).json()["volume"], 56);
}

TEST_F(EvalCommand, AFaceIsDividedWhereAnEdgeLiesInIt) {
    // A roof that stands on its ridge, inside the top of a box.
    const std::string roof =
        write("roof.csg",
              "union() { cube(size = [4, 4, 2]);\n"
              "polyhedron(points = [[1,1,2],[0,1,4],[2,1,4],[1,3,2],[0,3,4],[2,3,4]],\n"
              "faces = [[0,1,2],[5,4,3],[3,4,1,0],[5,3,0,2],[4,5,2,1]]); }\n");
    const Finished run = trisect({"eval", roof, "-o", path("roof.off"), "--json"});
    EXPECT_TRUE(run.json()["certificate"]["certified"]) << run.json();
    EXPECT_EQ(run.json()["divided"], 4);
    EXPECT_NE(run.err.find("edges lie in faces"), std::string::npos) << run.err;
    EXPECT_EQ(trisect({"check", path("roof.off"), "--json"}).json()["errors"], 0);
    const json without =
        trisect({"eval", roof, "-o", path("roof.off"), "--json", "--no-certificate"}).json();
    EXPECT_TRUE(without["certificate"].is_null());
    EXPECT_EQ(without["divided"], 0);
}

// Floats turn triangles over that are thinner than they are apart.
TEST_F(EvalCommand, ThinTrianglesAreGivenUp) {
    const std::string turned = write(
        "turned.csg",
        "union() {\n"
        "multmatrix([[1,0,0,2.4],[0,-0.0430475,0.999073,2.8],[0,-0.999073,-0.0430475,0],[0,0,0,1]])"
        " cube(size = [10, 10, 10], center = true);\n"
        "multmatrix([[1,0,0,2.5],[0,-0.998825,0.0484699,-1.9],[0,-0.0484699,-0.998825,-1.3],"
        "[0,0,0,1]]) cylinder(h = 14, r = 3, $fn = 8, center = true);\n"
        "cylinder(h = 12, r = 4, $fn = 12, center = true); }\n");
    const Finished run = trisect({"eval", turned, "-o", path("turned.stl"), "--json"});
    EXPECT_TRUE(run.json()["certificate"]["certified"]) << run.json();
    EXPECT_GT(run.json()["mended"]["radius"], 0);
    EXPECT_LT(run.json()["mended"]["radius"], 1e-4);
    EXPECT_NE(run.err.find("thinner than the rounding"), std::string::npos) << run.err;
    // The file has what the certificate is of.
    EXPECT_EQ(run.err.find("vertices rounded"), std::string::npos) << run.err;
    EXPECT_EQ(trisect({"check", path("turned.stl"), "--json"}).json()["errors"], 0);
    const json plain =
        trisect({"eval", turned, "-o", path("plain.stl"), "--json", "--no-certificate"}).json();
    EXPECT_TRUE(plain["mended"].is_null());
    EXPECT_GT(trisect({"check", path("plain.stl"), "--json"}).json()["errors"], 0);
}

// Areas of faces by colour, "" for those without one.
std::map<std::string, double> areas_by_color(const std::string& file, bool properties) {
    trisect::ReadOptions options;
    options.properties = properties;
    const trisect::Model model = trisect::read_model(file, options);
    std::map<std::string, double> out;
    for (const trisect::ModelPart& part : model.parts)
        for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
            const auto face = part.mesh.face(f);
            const auto& o = part.mesh.points[face[0]];
            std::array<double, 3> sum{};
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto& a = part.mesh.points[face[i]];
                    const auto& b = part.mesh.points[face[i + 1]];
                    const std::size_t u = (k + 1) % 3;
                    const std::size_t v = (k + 2) % 3;
                    sum[k] += ((a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u])) / 2;
                }
            const std::uint32_t m =
                part.materials.empty() ? trisect::no_material : part.materials[f];
            std::string color;
            if (m != trisect::no_material && model.materials[m].color)
                for (const std::uint8_t c : *model.materials[m].color)
                    color += std::to_string(c) + ' ';
            out[color] += std::hypot(sum[0], sum[1], sum[2]);
        }
    return out;
}

// Boxes of two heights in a row, regions between them, a hull, what is turned by 3-4-5, and what
// has no colour; the inner colour of the first one does not count.
TEST_F(EvalCommand, ColorsAreThoseOfFaces) {
    const std::string file = write("colors.csg", R"(
color([1, 0, 0, 1]) { cube(size = [2, 2, 2]); color([0, 1, 0, 1]) {
    multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,2],[0,0,0,1]]) { cube(size = [2, 2, 1]); } } }
color([0, 0, 1, 0.2]) { linear_extrude(height = 2) {
    multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { square(size = [1, 2]); } } }
color([0, 1, 1, 1]) { multmatrix([[0.6,-0.8,0,20],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) {
    difference() { cube(size = [5, 5, 5]); cube(size = [5, 5, 1]); } } }
multmatrix([[0.6,-0.8,0,40],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) { union() {
    color([1, 1, 0, 1]) { hull() { cube(size = 5); } }
    color([-1, -1, -1, 1]) {
        multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(size = 5); } } } }
)");
    const std::map<std::string, double> expected{{"", 125},
                                                 {"255 0 0 255 ", 4 + 4 + 6 * 3 + 2},
                                                 {"0 0 255 51 ", 2 + 2 + 4 + 2 + 2},
                                                 {"0 255 255 255 ", 50 + 80},
                                                 {"255 255 0 255 ", 125}};
    for (const std::string name : {"c.3mf", "c.glb", "c.obj", "c.ply"}) {
        const Finished run = trisect({"eval", file, "-o", path(name), "--json"});
        ASSERT_EQ(run.code, 0) << name << run.err;
        const auto found = areas_by_color(path(name), name == "c.obj" || name == "c.ply");
        EXPECT_EQ(found.size(), expected.size()) << name;
        for (const auto& [color, area] : expected) {
            ASSERT_TRUE(found.contains(color)) << name << ' ' << color;
            EXPECT_NEAR(found.at(color), area, 1e-4) << name << ' ' << color;
        }
    }
}

TEST_F(EvalCommand, StreamsAndSummary) {
    const Finished run =
        trisect({"eval", "-", "-o", "-", "--format", "obj", "--summary"}, {"cube(size = 2);", {}});
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.out.find("v 0 0 0"), std::string::npos);
    EXPECT_NE(run.err.find("volume       8"), std::string::npos);
}

TEST_F(EvalCommand, ErrorsHavePlaces) {
    const std::string bad = write("bad.csg", "group() {\n  roof();\n}\n");
    const Finished run = trisect({"eval", bad, "-o", path("x.stl"), "--json"});
    EXPECT_EQ(run.code, 7);
    EXPECT_EQ(run.json()["error"]["line"], 2);
    EXPECT_EQ(run.json()["error"]["column"], 3);
    EXPECT_NE(run.err.find("roof"), std::string::npos);
    EXPECT_EQ(trisect({"eval", write("c.csg", "cube("), "-o", path("x.stl")}).code, 3);
    EXPECT_FALSE(exists("x.stl"));
}

}  // namespace
