// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"
#include "xml.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::is_well_formed_xml;
using trisect::test::trisect;

class SectionCommand : public trisect::test::Scratch {
protected:
    json section(std::vector<std::string> options) {
        options.insert(options.begin(), "section");
        options.emplace_back("--json");
        const Finished result = trisect(options);
        EXPECT_EQ(result.code, 0) << result.err;
        return result.json();
    }
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
    std::string hole_ = box("hole.obj", {0, 0, 0}, {1, 1, 1});
    std::string shell_ = box("shell.obj", {-1, -1, -1}, {2, 2, 2});
    std::string out_ = path("s.svg");
};

TEST_F(SectionCommand, CubeGivesASquare) {
    const json document = section({cube_, "--plane", "0,0,2,-1"});
    EXPECT_EQ(document["schema"], "trisect.section/1");
    EXPECT_EQ(document["loops"], 1);
    EXPECT_EQ(document["corners"], 4);
    EXPECT_EQ(document["area"], 4);
    EXPECT_EQ(document["right"], json::array({1, 0, 0}));
    EXPECT_EQ(document["up"], json::array({0, 1, 0}));
    for (const json& corner : document["regions"][0]["outer"]) EXPECT_EQ(corner[2], 0.5);
}

TEST_F(SectionCommand, TheStandardOutputHoldsOneThing) {
    EXPECT_EQ(trisect({"section", cube_, "--plane", "z", "-o", "/dev/stdout"}).code, 2);
    EXPECT_EQ(trisect({"section", cube_, "--plane", "z", "-o", "/dev/stdout", "--json"}).code, 2);
    const Finished drawn = trisect({"section", cube_, "--plane", "z", "-o", "-"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_TRUE(is_well_formed_xml(drawn.out));
}

TEST_F(SectionCommand, ShortFormsAreAxes) {
    for (const char* plane : {"x", "y", "z", "x=0.25", "y=1.75", "z=0.1"}) {
        const json document = section({cube_, "--plane", plane});
        EXPECT_EQ(document["area"], 4) << plane;
        EXPECT_EQ(document["corners"], 4) << plane;
    }
    EXPECT_EQ(section({cube_, "--plane", "y=1.5"})["plane"], json::array({0, -1, 0, 1.5}));
}

TEST_F(SectionCommand, CavityIsAHole) {
    const json document =
        section({shell_, hole_, "--op", "difference", "--plane", "z", "-o", out_});
    EXPECT_EQ(document["loops"], 2);
    EXPECT_EQ(document["regions"].size(), 1U);
    EXPECT_EQ(document["regions"][0]["holes"].size(), 1U);
    EXPECT_EQ(document["area"], 8);
    const std::string svg = read(out_);
    EXPECT_TRUE(is_well_formed_xml(svg)) << svg;
    EXPECT_NE(svg.find("fill-rule=\"evenodd\""), std::string::npos);
}

TEST_F(SectionCommand, DrawingKeepsTheCoordinates) {
    const std::string file =
        write("t.obj",
              "v 0.125 0.25 -1\nv 0.75 0.25 -1\nv 0.125 1e3 -1\nv 0.125 0.25 1\n"
              "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    (void)section({file, "--plane", "z=-1", "-o", out_});
    const std::string svg = read(out_);
    for (const char* corner : {"0.125 0.25", "0.75 0.25", "0.125 1000"}) {
        EXPECT_NE(svg.find(corner), std::string::npos) << svg;
    }
}

TEST_F(SectionCommand, SlantedPlaneCutsAHexagon) {
    const json document = section({cube_, "--plane", "1,1,1,-3"});
    EXPECT_EQ(document["corners"], 6);
    EXPECT_NEAR(document["area"].get<double>(), 3 * 1.7320508075688772, 1e-12);
}

TEST_F(SectionCommand, PlaneThatMissesGivesNothing) {
    const json document = section({cube_, "--plane", "-1,0,0,7", "-o", out_});
    EXPECT_EQ(document["loops"], 0);
    EXPECT_EQ(document["area"], 0);
    EXPECT_TRUE(is_well_formed_xml(read(out_)));
}

TEST_F(SectionCommand, StandardOutputIsTheDrawing) {
    const Finished result = trisect({"section", cube_, "--plane", "z", "-o", "-"});
    ASSERT_EQ(result.code, 0);
    EXPECT_TRUE(is_well_formed_xml(result.out));
    EXPECT_NE(result.err.find("area 4"), std::string::npos) << result.err;
    EXPECT_NE(trisect({"section", cube_, "--plane", "z"}).out.find("area 4"), std::string::npos);
}

TEST_F(SectionCommand, MistakesAreUsageErrors) {
    for (const std::vector<std::string>& mistake :
         std::vector<std::vector<std::string>>{{},
                                               {"--plane", "0,0,0,1"},
                                               {"--plane", "1,2,3"},
                                               {"--plane", "up"},
                                               {"--plane", "z", "-o", path("s.png")},
                                               {"--plane", "z", "-o", "-", "--json"}}) {
        std::vector<std::string> arguments{"section", cube_};
        arguments.insert(arguments.end(), mistake.begin(), mistake.end());
        EXPECT_EQ(trisect(arguments).code, 2) << testing::PrintToString(mistake);
    }
}

}  // namespace
