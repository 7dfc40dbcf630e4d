// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

#if defined(TRISECT_TEST_3MF)
constexpr bool has_3mf = true;
#else
constexpr bool has_3mf = false;
#endif

class ConvertCommand : public trisect::test::Scratch {
protected:
    json info(const std::string& file) { return trisect({"info", file, "--json"}).json(); }
    /// Converts the box and describes the result.
    json converted(std::vector<std::string> options) {
        options.insert(options.begin(), {"convert", box_, "-o", out_});
        EXPECT_EQ(trisect(options).code, 0);
        return info(out_);
    }
    std::string box_ = box("a.obj", {0, 0, 0}, {1, 2, 3});
    std::string out_ = path("b.obj");
};

TEST_F(ConvertCommand, EveryFormatIsReadBack) {
    for (const char* name : {"b.obj", "b.off", "b.ply", "b.stl"}) {
        ASSERT_EQ(trisect({"convert", box_, "-o", path(name)}).code, 0) << name;
        const json description = info(path(name));
        EXPECT_EQ(description["volume"], 6) << name;
        EXPECT_EQ(description["vertices"], 8) << name;
        EXPECT_EQ(description["closed"], true) << name;
    }
    EXPECT_EQ(info(path("b.off"))["faces"], 6);
    EXPECT_EQ(info(path("b.stl"))["faces"], 12);  // STL knows triangles only
}

TEST_F(ConvertCommand, ModelsAreReadBack) {
    if (!has_3mf) GTEST_SKIP() << "built without libzip or expat";
    for (const char* name : {"b.3mf", "b.glb", "b.amf"}) {
        const Finished written = trisect({"convert", box_, "-o", path(name)});
        ASSERT_EQ(written.code, 0) << name;
        const json description = info(path(name));
        EXPECT_EQ(description["volume"], 6) << name;
        EXPECT_EQ(description["vertices"], 8) << name;
        EXPECT_EQ(description["faces"], 12) << name;
        EXPECT_EQ(description["parts"].size(), 1U) << name;
        EXPECT_EQ(trisect({"diff", box_, path(name)}).code, 0) << name;
    }
    EXPECT_EQ(info(path("b.3mf"))["unit"], "millimeter");
    EXPECT_EQ(trisect({"convert", box_, "-o", path("b.dxf")}).code, 7);
}

TEST_F(ConvertCommand, StepHasPlanarFaces) {
    ASSERT_EQ(trisect({"convert", box_, "-o", path("b.step")}).code, 0);
    const json description = info(path("b.step"));
    EXPECT_EQ(description["volume"], 6);
    EXPECT_EQ(description["faces"], 6);
    EXPECT_EQ(description["unit"], "millimeter");
    EXPECT_EQ(trisect({"diff", box_, path("b.step")}).code, 0);
    // A turned box is not planar to the last digit, but to the uncertainty that the file states.
    ASSERT_EQ(trisect({"convert", box_, "-o", path("t.stp"), "--rotate", "1,2,3,30"}).code, 0);
    EXPECT_EQ(info(path("t.stp"))["faces"], 6);
    // A lifted corner makes three faces uneven.
    const std::string uneven = write("u.obj",
                                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                                     "v 1 1 1.5\nv 0 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n"
                                     "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    ASSERT_EQ(trisect({"convert", uneven, "-o", path("u.step")}).code, 0);
    EXPECT_EQ(info(path("u.step"))["faces"], 7);
    EXPECT_EQ(trisect({"diff", uneven, path("u.step")}).code, 0);
}

TEST_F(ConvertCommand, PartsAndUnitsAreKept) {
    if (!has_3mf) GTEST_SKIP() << "built without libzip or expat";
    const std::string coordinates =
        "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
        "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
        "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex>";
    const std::string object = "<mesh><vertices>" + coordinates +
                               "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3>"
                               "</triangle></volume></mesh></object>";
    const std::string amf = write(
        "a.amf", "<amf unit=\"inch\"><object id=\"1\"><metadata type=\"name\">first</metadata>" +
                     object + "<object id=\"2\">" + object + "</amf>");
    const Finished written =
        trisect({"convert", amf, "-o", path("a.3mf"), "--scale", "2", "--json"});
    ASSERT_EQ(written.code, 0);
    EXPECT_NE(written.err.find("in the unit inch"), std::string::npos) << written.err;
    const json description = info(path("a.3mf"));
    EXPECT_EQ(description["unit"], "inch");
    ASSERT_EQ(description["parts"].size(), 2U);
    EXPECT_EQ(description["parts"][0]["name"], "first");
    EXPECT_EQ(description["bounds"]["upper"], json::array({2, 2, 0}));
}

TEST_F(ConvertCommand, FormatOverridesTheName) {
    ASSERT_EQ(trisect({"convert", box_, "-o", out_, "--format", "stl-ascii"}).code, 0);
    EXPECT_EQ(read(out_).substr(0, 5), "solid");
    EXPECT_EQ(trisect({"info", out_}).code, 3);
    EXPECT_EQ(trisect({"info", out_, "--input-format", "stl"}).code, 0);
}

TEST_F(ConvertCommand, TranslationAndScaleAreExact) {
    const json moved = converted({"--translate", "-.5,10,1e3", "--scale", "2"});
    EXPECT_EQ(moved["volume"], 48);
    EXPECT_EQ(moved["bounds"]["lower"], json::array({-0.5, 10, 1000}));
    EXPECT_EQ(moved["bounds"]["upper"], json::array({1.5, 14, 1006}));
}

TEST_F(ConvertCommand, QuarterTurnIsExact) {
    const json turned = converted({"--rotate", "0,0,7,-90"});
    EXPECT_EQ(turned["bounds"]["lower"], json::array({0, -1, 0}));
    EXPECT_EQ(turned["bounds"]["upper"], json::array({2, 0, 3}));
    EXPECT_EQ(turned["volume"], 6);
    const json back = converted({"--rotate", "-1,0,0,450"});
    EXPECT_EQ(back["bounds"]["lower"], json::array({0, 0, -2}));
    EXPECT_EQ(back["bounds"]["upper"], json::array({1, 3, 0}));
}

TEST_F(ConvertCommand, OtherRotationsReportTheRounding) {
    const Finished result =
        trisect({"convert", box_, "-o", out_, "--rotate", "1,2,3,37", "--json"});
    const json document = result.json();
    EXPECT_EQ(document["schema"], "trisect.convert/1");
    EXPECT_GT(document["rounding"]["moved"], 0);
    EXPECT_GT(document["rounding"]["max_move"], 0);
    EXPECT_LT(document["rounding"]["max_move"], 1e-15);
    EXPECT_EQ(document["matrix"].size(), 12U);
    EXPECT_NEAR(info(out_)["volume"].get<double>(), 6, 1e-10);
}

TEST_F(ConvertCommand, MirrorKeepsTheOutsideOutside) {
    EXPECT_EQ(converted({"--scale", "-1"})["volume"], 6);
    const std::string matrix = write("m.txt", "-1 0 0 5\n0 1 0 0\n0 0 1 0\n");
    const json mirrored = converted({"--matrix", matrix});
    EXPECT_EQ(mirrored["volume"], 6);
    EXPECT_EQ(mirrored["bounds"]["upper"], json::array({5, 2, 3}));
    EXPECT_EQ(trisect({"check", out_}).code, 0);
}

TEST_F(ConvertCommand, MatrixFileErrorsHavePlaces) {
    for (const char* text : {"", "1 2 3", "1 0 0 0\n0 1 0 x\n0 0 1 0\n",
                             "1 0 0 0 0 1 0 0 0 0 1 0 9", "nan 0 0 0 0 1 0 0 0 0 1 0"}) {
        const Finished result =
            trisect({"convert", box_, "-o", out_, "--matrix", write("m.txt", text), "--json"});
        EXPECT_EQ(result.code, 3) << text;
        EXPECT_EQ(result.json()["error"]["file"], path("m.txt")) << text;
    }
    const Finished result = trisect({"convert", box_, "-o", out_, "--matrix",
                                     write("m.txt", "1 0 0 0\n0 1 0 x\n0 0 1 0\n"), "--json"});
    EXPECT_EQ(result.json()["error"]["line"], 2);
    EXPECT_EQ(result.json()["error"]["column"], 7);
    EXPECT_FALSE(exists("b.obj"));
}

TEST_F(ConvertCommand, LatticeRounds) {
    const json document =
        trisect({"convert", box_, "-o", out_, "--lattice", "8", "--translate", "0,0,300", "--json"})
            .json();
    EXPECT_EQ(document["lattice"]["moved"], 8);
    EXPECT_EQ(document["lattice"]["max_move"], 47);
}

TEST_F(ConvertCommand, ExactBoundariesAreOutputsAndInputs) {
    const std::string exact = path("box.exact");
    EXPECT_EQ(trisect({"convert", box_, "-o", exact, "--json"}).json()["format"], "exact");
    EXPECT_EQ(trisect({"convert", exact, "-o", path("again.off")}).code, 0);
    EXPECT_EQ(trisect({"diff", box_, path("again.off")}).code, 0);
    EXPECT_EQ(trisect({"convert", exact, "-o", path("box.trisect")}).code, 0);
    EXPECT_EQ(trisect({"diff", exact, path("box.trisect")}).code, 0);
    // What a boolean writes is what it writes beside a mesh.
    const std::string other = write("other.off",
                                    "OFF\n4 4 0\n0 0 0\n3 0.3 0\n0 3 0.1\n0.2 0 3\n"
                                    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    EXPECT_EQ(trisect({"difference", box_, other, "-o", path("d.exact")}).code, 0);
    EXPECT_EQ(trisect({"difference", box_, other, "-o", path("d.off"), "--boundary",
                       path("beside.exact")})
                  .code,
              0);
    EXPECT_EQ(read(path("d.exact")), read(path("beside.exact")));
    EXPECT_EQ(trisect({"difference", box_, other, "-o", path("f.exact"), "--faces"}).code, 2);
}

TEST_F(ConvertCommand, OpenMeshesPass) {
    EXPECT_EQ(trisect({"convert", open_box("open.obj"), "-o", path("open.stl")}).code, 0);
    EXPECT_EQ(info(path("open.stl"))["faces"], 10);
}

}  // namespace
