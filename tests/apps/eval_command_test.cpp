// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <trisect/brep/io/read_model.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

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

TEST_F(EvalCommand, ProgramsAsJson) {
    const Finished written = trisect({"eval", model_, "-o", path("p.json"), "--json"});
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(written.json()["nodes"], 3);
    const std::string program = read(path("p.json"));
    EXPECT_EQ(json::parse(program)["nodes"][0]["node"], "difference");
    EXPECT_EQ(trisect({"eval", path("p.json"), "-o", path("p.off"), "--json"}).json()["volume"],
              56);
    const Finished stream =
        trisect({"eval", "-", "--program", "json", "-o", path("p.off"), "--json"}, {program, {}});
    EXPECT_EQ(stream.json()["volume"], 56);
    // Files start where they did, wherever the program is written.
    ASSERT_EQ(trisect({"eval", model_, "-o", path("a.off")}).code, 0);
    const std::string importing = write("i.csg", "import(file = \"a.off\");");
    std::filesystem::create_directory(path("below"));
    ASSERT_EQ(trisect({"eval", importing, "-o", path("below/i.json")}).code, 0);
    EXPECT_EQ(
        trisect({"eval", path("below/i.json"), "-o", path("p.off"), "--json"}).json()["volume"],
        56);
    // Errors at evaluation have the place in the first text.
    ASSERT_EQ(trisect({"eval",
                       write("o.csg",
                             "\n polyhedron([[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"
                             "[[0,1,2]]);"),
                       "-o", path("o.json")})
                  .code,
              0);
    const json error =
        trisect({"eval", path("o.json"), "-o", path("x.stl"), "--json"}).json()["error"];
    EXPECT_EQ(error["code"], 4);
    EXPECT_EQ(error["line"], 2);
    EXPECT_NE(error["file"].get<std::string>().find("o.csg"), std::string::npos);
    const Finished unknown =
        trisect({"eval", write("u.json", "{\"nodes\": [\n{\"node\": \"cube\", \"sides\": 4}]}"),
                 "-o", path("x.stl"), "--json"});
    EXPECT_EQ(unknown.code, 7);
    EXPECT_EQ(unknown.json()["error"]["line"], 2);
    EXPECT_NE(unknown.err.find("'sides'"), std::string::npos);
    EXPECT_EQ(trisect({"eval", model_, "-o", path("p.json"), "--summary"}).code, 2);
}

TEST_F(EvalCommand, SummaryCountsNodesByName) {
    const std::string file =
        write("s.csg", "cube(size = 1); cube(size = 1); hull() { cube(size = 2); }");
    const Finished run = trisect({"eval", file, "-o", path("s.off"), "--summary", "--json"});
    const json document = run.json();
    EXPECT_EQ(document["by_name"]["cube"]["nodes"], 3);
    EXPECT_EQ(document["by_name"]["cube"]["found_again"], 1);
    EXPECT_EQ(document["by_name"]["hull"]["nodes"], 1);
    EXPECT_EQ(document["found_again"], 1);
    EXPECT_GT(document["peak_memory"], 1e6);
    EXPECT_NE(run.err.find("cube"), std::string::npos);
    EXPECT_NE(run.err.find("MB at most"), std::string::npos);
}

TEST_F(EvalCommand, NumbersOfOpenScadAreSaidToBe) {
    const std::string file = write("g.csg", "cube(size = [0.1, 1, 1]);");
    const Finished run = trisect({"eval", file, "-o", path("g.off"), "--json", "--openscad-grid"});
    EXPECT_EQ(run.json()["exact_volume"], "104857/1048576");
    EXPECT_EQ(run.json()["openscad_grid"], true);
    EXPECT_NE(run.err.find("for comparison only"), std::string::npos);
    EXPECT_EQ(trisect({"eval", file, "-o", path("g.off"), "--json"}).json()["openscad_grid"],
              false);
    const std::string hull = write("h.csg", "hull() { cube(size = 1); }");
    EXPECT_EQ(trisect({"eval", hull, "-o", path("g.off"), "--openscad-grid"}).code, 7);
    EXPECT_EQ(trisect({"eval", file, "-o", path("g.off"), "--openscad-grid", "--watch"}).code, 2);
    EXPECT_EQ(trisect({"eval", file, "-o", path("g.json"), "--openscad-grid"}).code, 2);
}

// A program in the place of OpenSCAD. It has the name of its folder for temporary files.
class EvalScad : public EvalCommand {
protected:
    [[nodiscard]] std::string stand_in(const std::string& name, const std::string& body) const {
        const std::string file =
            write(name,
                  "#!/bin/sh\nfor a in \"$@\"; do case \"$last\" in -o) out=$a;; -d) rule=$a;; -D) "
                  "defined=\"$defined$a;\";; esac; last=$a; done\nmodel=$last\n"
                  "dirname \"$out\" > '" +
                      path("where") + "'\n" + body);
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file;
    }
    /// Whether the folder is gone in which the stand-in wrote.
    [[nodiscard]] bool is_tidy() const {
        std::string where = read(path("where"));
        where.resize(where.find('\n'));
        return !where.empty() && !std::filesystem::exists(where);
    }
    std::string scad_ = write("p.scad", "cube(w);\n");
};

TEST_F(EvalScad, IsEvaluatedByOpenScad) {
    ASSERT_EQ(trisect({"eval", model_, "-o", path("a.off")}).code, 0);
    const std::string program = stand_in(
        "openscad",
        "echo \"ECHO: $defined\"; echo WARNING: odd >&2; echo \"$model\" > \"$rule\"\n"
        "echo 'import(file = \"a.off\"); multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
        "cube(size = 2);' > \"$out\"\n");
    const Finished run = trisect({"eval", "-D", "w=3", "-D", "v=[1, \"a b\"]", scad_, "-o",
                                  path("p.off"), "--openscad", program, "--json"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.json()["volume"], 64);
    EXPECT_NE(run.err.find("openscad: ECHO: w=3;v=[1, \"a b\"];\n"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("openscad: WARNING: odd"), std::string::npos);
    EXPECT_TRUE(is_tidy());
    // By the environment as well, and into JSON.
    const Finished variable =
        trisect({"eval", scad_, "-o", path("p.json")}, {{}, {{"TRISECT_OPENSCAD", program}}});
    EXPECT_EQ(variable.code, 0) << variable.err;
    EXPECT_EQ(trisect({"eval", path("p.json"), "-o", path("p.off"), "--json"}).json()["volume"],
              64);
}

TEST_F(EvalScad, WhatIsWrongIsSaid) {
    const Finished missing =
        trisect({"eval", scad_, "-o", path("p.off"), "--json"}, {{}, {{"PATH", "/nowhere"}}});
    EXPECT_EQ(missing.code, 8);
    EXPECT_EQ(missing.json()["error"]["kind"], "missing_program");
    EXPECT_NE(missing.err.find("--openscad"), std::string::npos);
    const std::string failing =
        stand_in("failing", "echo 'ERROR: Parser error in line 3' >&2; exit 1\n");
    const Finished failed = trisect({"eval", scad_, "-o", path("p.off"), "--openscad", failing});
    EXPECT_EQ(failed.code, 3);
    EXPECT_NE(failed.err.find("ended with code 1: ERROR: Parser error in line 3"),
              std::string::npos)
        << failed.err;
    EXPECT_TRUE(is_tidy());
    const std::string silent = stand_in("silent", "exit 0\n");
    EXPECT_EQ(trisect({"eval", scad_, "-o", path("p.off"), "--openscad", silent}).code, 3);
    const std::string odd = stand_in("odd", "echo '\n roof();' > \"$out\"\n");
    const Finished refused =
        trisect({"eval", scad_, "-o", path("p.off"), "--openscad", odd, "--json"});
    EXPECT_EQ(refused.code, 7);
    EXPECT_EQ(refused.json()["error"]["line"], 2);
    EXPECT_FALSE(exists("p.off"));
    EXPECT_EQ(trisect({"eval", scad_, "-o", path("p.off"), "-D", "3"}).code, 2);
    EXPECT_EQ(trisect({"eval", model_, "-o", path("p.off"), "-D", "w=3"}).code, 2);
    EXPECT_EQ(trisect({"eval", "-", "--program", "scad", "-o", path("p.off")}).code, 2);
    // A file that is there and no program.
    EXPECT_EQ(trisect({"eval", scad_, "-o", path("p.off"), "--openscad", scad_}).code, 3);
}

TEST_F(EvalScad, ACancelEndsOpenScadAsWell) {
    const std::string slow = stand_in(
        "slow", "echo $$ > '" + path("pid") + "'; sleep 600; touch '" + path("late") + "'\n");
    trisect::test::Waiting run({"eval", scad_, "-o", path("p.off"), "--openscad", slow});
    for (int i = 0; i < 600 && (!exists("pid") || read(path("pid")).empty()); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const int process = std::stoi(read(path("pid")));
    run.send_signal(SIGINT);
    EXPECT_EQ(run.finish().code, 6);
    EXPECT_NE(::kill(process, 0), 0);
    EXPECT_TRUE(is_tidy());
    EXPECT_FALSE(exists("p.off"));
    EXPECT_EQ(
        trisect({"eval", scad_, "-o", path("p.off"), "--openscad", slow, "--max-seconds", "0.5"})
            .code,
        5);
    EXPECT_TRUE(is_tidy());
}

// Sums of many pieces take longer than this waits.
TEST_F(EvalCommand, ACancelWithinOneNodeLeavesNoOutput) {
    const std::string slow =
        write("slow.csg",
              "minkowski() { difference() { sphere(r = 9, $fn = 90); sphere(r = 8, $fn = 90); }\n"
              "difference() { sphere(r = 3, $fn = 40); sphere(r = 2, $fn = 40); } }");
    const Finished run =
        trisect({"eval", slow, "-o", path("s.off"), "--max-seconds", "1", "--json"});
    EXPECT_EQ(run.code, 5) << run.err;
    EXPECT_FALSE(exists("s.off"));
}

}  // namespace
