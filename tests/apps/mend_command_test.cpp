// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <trisect/brep/validate/defect.h>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

constexpr const char* corners =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
constexpr const char* lower_faces = "f 1 3 4 2\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n";

class MendCommand : public trisect::test::Scratch {
protected:
    /// A cube with its last two faces as they are given.
    std::string cube(const std::string& name, const std::string& others) {
        return write(name, std::string(corners) + lower_faces + others);
    }
    [[nodiscard]] json check(const std::string& file) const {
        return trisect({"check", file, "--json"}).json();
    }
    [[nodiscard]] double volume(const std::string& file) const {
        return trisect({"info", file, "--json"}).json()["volume"].get<double>();
    }
    std::string out_ = path("out.obj");
};

TEST_F(MendCommand, NothingWithoutAnOption) {
    const Finished result = trisect({"mend", cube("a.obj", "f 5 6 8 7\nf 2 4 8 6\n"), "-o", out_});
    EXPECT_EQ(result.code, 2);
    for (const char* option : {"--orient", "--shells", "--seams", "--drop", "--fill", "--all"})
        EXPECT_NE(result.err.find(option), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(MendCommand, FacesAreTurnedOver) {
    const std::string file = cube("a.obj", "f 5 7 8 6\nf 2 4 8 6\n");
    const Finished before = trisect({"union", file, file, "-o", out_});
    EXPECT_EQ(before.code, 4);
    EXPECT_NE(before.err.find("trisect: hint: open_edge: 'trisect mend "), std::string::npos)
        << before.err;
    EXPECT_NE(before.err.find("'--orient' turns faces over"), std::string::npos) << before.err;
    EXPECT_NE(check(file)["ways_out"]["flipped_face"].get<std::string>().find("mend --orient"),
              std::string::npos);
    const Finished result = trisect({"mend", file, "-o", out_, "--orient", "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    const json document = result.json();
    EXPECT_EQ(document["schema"], "trisect.mend/1");
    EXPECT_EQ(document["closed"], true);
    EXPECT_EQ(document["mended"]["turned_faces"]["count"], 1);
    EXPECT_EQ(document["mended"]["turned_faces"]["first"], json::array({4}));
    EXPECT_EQ(check(out_)["solid"], true);
    EXPECT_EQ(volume(out_), 1);
    const Finished text = trisect({"mend", file, "-o", out_, "--orient"});
    EXPECT_EQ(text.out, "");
    EXPECT_NE(text.err.find("turned over  1 faces: 4"), std::string::npos) << text.err;
}

TEST_F(MendCommand, WhatStaysOpenIsWrittenWithCodeOne) {
    const std::string file = cube("a.obj", "f 2 4 8 6\n");
    const Finished result = trisect({"mend", file, "-o", out_, "--all", "1e-6", "--json"});
    EXPECT_EQ(result.code, 1) << result.err;
    const json document = result.json();
    EXPECT_EQ(document["closed"], false);
    const json hole = document["mended"]["open"]["first"][0];
    EXPECT_EQ(hole["edges"], 4);
    EXPECT_EQ(hole["length"], 4);
    EXPECT_EQ(hole["loop"], true);
    EXPECT_EQ(hole["place"], json::array({0, 0, 1}));
    EXPECT_EQ(check(out_)["counts"]["open_edge"], 4);
    const Finished text = trisect({"mend", file, "-o", out_, "--all", "0"});
    EXPECT_NE(text.err.find("still open   4 edges, 4 long, a loop at vertex 4 (0, 0, 1)"),
              std::string::npos)
        << text.err;
    // Filled, it is closed.
    EXPECT_EQ(trisect({"mend", out_, "-o", path("full.obj"), "--fill"}).code, 0);
    EXPECT_EQ(volume(path("full.obj")), 1);
}

TEST_F(MendCommand, SeamsOfAnStlWithFewDigits) {
    std::string stl = "solid x\n";
    const auto facet = [&](const std::string& a, const std::string& b, const std::string& c) {
        stl += "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
               "\nendloop\nendfacet\n";
    };
    facet("0 0 0", "0 1 0", "1 0 0");
    facet("0 0 0", "1.0001 0 0", "0 0 1");
    facet("0 0 0", "0 0 1", "0 1 0.0001");
    facet("1 0 0", "0 1 0", "0 0 0.9999");
    const std::string file = write("a.stl", stl + "endsolid x\n");
    EXPECT_EQ(trisect({"union", file, file, "-o", out_}).code, 4);
    const json document = trisect({"mend", file, "-o", out_, "--seams", "2e-4", "--json"}).json();
    EXPECT_EQ(document["closed"], true);
    EXPECT_EQ(document["vertices"], 4);
    EXPECT_EQ(document["mended"]["joined_vertices"]["count"], 3);
    EXPECT_NEAR(document["mended"]["max_move"].get<double>(), 1e-4, 1e-9);
    EXPECT_NEAR(volume(out_), 1.0 / 6, 1e-4);
    EXPECT_EQ(trisect({"mend", file, "-o", out_, "--seams", "1e-5"}).code, 1);
}

TEST_F(MendCommand, ShellsAndInnerOnes) {
    const std::string outside = cube("a.obj", "f 5 6 8 7\nf 2 4 8 6\n");
    std::string text = std::string(corners) + lower_faces + "f 5 6 8 7\nf 2 4 8 6\n";
    // The same cube, smaller, within, and with the same orientation.
    text +=
        "v .2 .2 .2\nv .8 .2 .2\nv .2 .8 .2\nv .8 .8 .2\nv .2 .2 .8\nv .8 .2 .8\nv .2 .8 .8\nv .8 "
        ".8 .8\n";
    text +=
        "f 9 11 12 10\nf 9 10 14 13\nf 11 15 16 12\nf 9 13 15 11\nf 13 14 16 15\nf 10 12 16 14\n";
    const std::string file = write("two.obj", text);
    EXPECT_EQ(check(file)["counts"]["shell_nesting"], 1);
    EXPECT_EQ(trisect({"mend", file, "-o", out_, "--shells"}).code, 0);
    EXPECT_EQ(check(out_)["solid"], true);
    EXPECT_NEAR(volume(out_), 1 - 0.216, 1e-12);
    EXPECT_EQ(trisect({"mend", file, "-o", out_, "--shells", "--inner", "material"}).code, 0);
    EXPECT_NEAR(volume(out_), 1 + 0.216, 1e-12);
    // As material, resolved.
    EXPECT_EQ(trisect({"resolve", out_, "-o", out_}).code, 0);
    EXPECT_EQ(volume(out_), 1);
}

TEST_F(MendCommand, RefusesWhatIsNoMesh) {
    const std::string file = cube("a.obj", "f 5 6 8 7\nf 2 4 8 6\n");
    for (const char* name : {"b.exact", "b.trisect", "b.dxf", "b.unknown"}) {
        const Finished result = trisect({"mend", file, "-o", path(name), "--orient"});
        EXPECT_TRUE(result.code == 2 || result.code == 7) << name << result.err;
        EXPECT_FALSE(std::filesystem::exists(path(name)));
    }
    ASSERT_EQ(trisect({"convert", file, "-o", path("a.exact")}).code, 0);
    EXPECT_EQ(trisect({"mend", path("a.exact"), "-o", out_, "--orient"}).code, 2);
    EXPECT_EQ(trisect({"mend", file, "-o", out_, "--seams", "-1"}).code, 2);
    EXPECT_EQ(trisect({"mend", file, "-o", out_, "--seams", "nan"}).code, 2);
    EXPECT_EQ(trisect({"mend", path("none.obj"), "-o", out_, "--orient"}).code, 3);
    EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(MendCommand, OfAnEmptyMesh) {
    EXPECT_EQ(trisect({"mend", write("e.obj", "# nothing\n"), "-o", out_, "--all", "1"}).code, 0);
}

class ResolveCommand : public MendCommand {};

TEST_F(ResolveCommand, AMeshThatMeetsItself) {
    const std::string text = trisect::test::box_text({0, 0, 0}, {2, 2, 2}) +
                             trisect::test::box_text({1, 1, 1}, {3, 3, 3}, 9);
    const std::string file = write("two.obj", text);
    const Finished result = trisect({"resolve", file, "-o", out_, "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    const json document = result.json();
    EXPECT_EQ(document["schema"], "trisect.boolean/1");
    EXPECT_EQ(document["op"], "resolve");
    EXPECT_EQ(document["output"]["volume"], 15);
    EXPECT_FALSE(document["certificate"].is_null());
    EXPECT_EQ(check(out_)["errors"], 0);
    // What `union A A` makes.
    const json twice = trisect({"union", file, file, "-o", path("twice.obj"), "--json"}).json();
    EXPECT_EQ(twice["output"]["volume"], document["output"]["volume"]);
    EXPECT_EQ(twice["output"]["triangles"], document["output"]["triangles"]);
    EXPECT_EQ(trisect({"resolve", file, "-o", path("r.obj"), "--repair", "--faces"}).code, 0);
    EXPECT_EQ(trisect({"resolve", file, "-o", path("r.exact")}).code, 0);
    EXPECT_EQ(trisect({"resolve", file, file, "-o", out_}).code, 2);
}

TEST_F(ResolveCommand, InsideOut) {
    const std::string file =
        write("a.obj", std::string(corners) +
                           "f 2 4 3 1\nf 5 6 2 1\nf 4 8 7 3\nf 3 7 5 1\nf 7 8 6 5\nf 6 8 4 2\n");
    const Finished refused = trisect({"resolve", file, "-o", out_});
    EXPECT_EQ(refused.code, 4);
    EXPECT_NE(refused.err.find("trisect: hint: 'trisect mend --shells'"), std::string::npos)
        << refused.err;
    EXPECT_EQ(trisect({"resolve", file, "-o", out_, "--winding", "nonzero"}).code, 0);
    EXPECT_EQ(volume(out_), 1);
    const std::string open = cube("open.obj", "");
    const json error = trisect({"resolve", open, "-o", path("no.obj"), "--json"}).json();
    EXPECT_EQ(error["error"]["code"], 4);
    EXPECT_NE(error["error"]["hint"].get<std::string>().find("trisect mend --seams"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path("no.obj")));
}

// The page and `check` have a way out of each kind, and the page names the command that `check`
// does.
TEST(WaysOut, EachKindHasOne) {
    std::ifstream page(TRISECT_SOURCE_FOLDER "/docs/invalid_solid.md");
    std::stringstream text;
    text << page.rdbuf();
    for (std::size_t k = 0; k < trisect::defect_kind_count; ++k) {
        const auto kind = static_cast<trisect::DefectKind>(k);
        EXPECT_NE(text.str().find("`" + std::string(name_of(kind)) + "`"), std::string::npos)
            << name_of(kind);
    }
}

TEST_F(MendCommand, CheckNamesTheWayOut) {
    const Finished open = trisect({"check", cube("a.obj", "f 2 4 8 6\n")});
    EXPECT_NE(open.out.find("way out of open_edge: 'trisect mend --seams D'"), std::string::npos)
        << open.out;
    const json report = check(path("a.obj"));
    EXPECT_EQ(report["ways_out"].size(), 1U);
    EXPECT_NE(report["ways_out"]["open_edge"].get<std::string>().find("--fill"), std::string::npos);
}

}  // namespace
