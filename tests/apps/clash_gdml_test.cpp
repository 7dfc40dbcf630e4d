// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

/// A mother, a cube of 10, with what is placed in it.
class ClashGdml : public trisect::test::Scratch {
protected:
    std::string define;
    std::string solids = R"(<box name="cube" x="10" y="10" z="10"/>)";
    std::string volumes;
    std::string placed;

    [[nodiscard]] std::string text() const {
        return "<gdml><define>" + define + "</define><materials/><solids>" + solids +
               "</solids><structure>" + volumes +
               R"(<volume name="mother"><solidref ref="cube"/>)" + placed +
               R"(</volume></structure><setup><world ref="mother"/></setup></gdml>)";
    }
    void add_solid(const std::string& name, const std::string& element) {
        solids += element;
        volumes += R"(<volume name=")" + name + R"("><solidref ref=")" + name + R"("/></volume>)";
    }
    void place(const std::string& volume, const std::string& where, const std::string& name) {
        placed += R"(<physvol name=")" + name + R"("><volumeref ref=")" + volume + R"("/>)" +
                  where + "</physvol>";
    }
    [[nodiscard]] Finished run(const std::vector<std::string>& more = {}) const {
        return run_text(text(), more);
    }
    [[nodiscard]] Finished run_text(const std::string& gdml,
                                    const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"clash", write("geometry.gdml", gdml), "-o",
                                           path("report.json"), "--volumes"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return trisect(arguments);
    }
    [[nodiscard]] json report() const { return json::parse(read(path("report.json"))); }
    /// "a-b relation volume", without the mother's name.
    [[nodiscard]] std::set<std::string> found() const {
        std::set<std::string> out;
        const json document = report();
        for (const json& clash : document["clashes"])
            out.insert(short_name(clash["a"]) + "-" + short_name(clash["b"]) + " " +
                       clash["relation"].get<std::string>() + " " +
                       clash["volume"]["exact"].get<std::string>());
        return out;
    }

private:
    static std::string short_name(const std::string& id) {
        return id.substr(id.find('/') == std::string::npos ? 0 : id.find('/') + 1);
    }
};

using Found = std::set<std::string>;

TEST_F(ClashGdml, DecimalsAreFlush) {
    // A tenth, two tenths and three tenths: in doubles there would be a gap and an overlap.
    define = R"(<constant name="t" value="0.1"/><position name="p" x="3*t" y="0" z="0"/>)";
    add_solid("b", R"(<box name="b" x="2*t" y="0.02" z="1" lunit="cm"/>)");
    add_solid("c", R"(<box name="c" x="0.2" y="0.2" z="1"/>)");
    place("c", R"(<positionref ref="p"/>)", "one");
    place("c", R"(<position x="t"/>)", "two");
    place("b", R"(<position x="4" y="0.2" unit="mm"/>)", "at the wall");
    EXPECT_EQ(run().code, 0);
    EXPECT_EQ(found(), Found{});
    EXPECT_EQ(report()["geometry"]["pairs"]["exact"], 4);
    place("c", R"(<position x="0.1" y="0.199999999"/>)", "by a step");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(found(), (Found{"two-by a step overlapping 1/5000000000"}));
}

TEST_F(ClashGdml, ProtrusionsAndOverlaps) {
    add_solid("c", R"(<box name="c" x="2" y="2" z="2"/>)");
    place("c", R"(<position x="4.5"/>)", "half out");
    place("c", R"(<position y="8"/>)", "outside");
    place("c", R"(<position x="4" y="1" z="1"/>)", "flush");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(found(), (Found{"half out-mother overlapping 2", "outside-mother disjoint 8",
                              "half out-flush overlapping 3/2"}));
}

TEST_F(ClashGdml, RotationsTurnAsInGeant4) {
    // A placement turns by the inverse, an operand of a boolean does not.
    add_solid("w", R"(<tet name="w" vertex1="o" vertex2="x" vertex3="y" vertex4="z"/>)");
    define = R"(<position name="o"/><position name="x" x="2"/><position name="y" y="3"/>)"
             R"(<position name="z" z="4"/>)";
    add_solid("c", R"(<box name="c" x="1" y="1" z="1"/>)");
    place("w", R"(<rotation z="90" unit="deg"/>)", "turned");  // x to -y, y to x
    place("c", R"(<position x="2.5" y="-0.5" z="0.5"/>)", "there");
    place("c", R"(<position x="-2.5" y="0.5" z="0.5"/>)", "elsewhere");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(report()["clashes"][0]["b"], "mother/there");
    EXPECT_EQ(report()["clashes"].size(), 1U);
    solids += R"(<box name="big" x="9" y="9" z="9"/>)";
    add_solid("rest", R"(<intersection name="rest"><first ref="big"/><second ref="w"/>)"
                      R"(<rotation z="90" unit="deg"/></intersection>)");  // y to -x
    placed.clear();
    place("rest", "", "turned");
    place("c", R"(<position x="2.5" y="-0.5" z="0.5"/>)", "there");
    place("c", R"(<position x="-2.5" y="0.5" z="0.5"/>)", "elsewhere");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(report()["clashes"][0]["b"], "mother/elsewhere");
    EXPECT_EQ(report()["clashes"].size(), 1U);
}

TEST_F(ClashGdml, TubesThatFitShareTheirFacets) {
    const std::string whole = R"( z="5" deltaphi="360" aunit="deg")";
    add_solid("inner", R"(<tube name="inner" rmin="1" rmax="2")" + whole + "/>");
    add_solid("outer", R"(<tube name="outer" rmin="2" rmax="3")" + whole + "/>");
    add_solid("cone",
              R"(<cone name="cone" rmin1="3" rmax1="4" rmin2="3" rmax2="4.5")" + whole + "/>");
    add_solid("hull", R"(<polycone name="hull" deltaphi="360" aunit="deg">)"
                      R"(<zplane rmin="3" rmax="4" z="-2.5"/><zplane rmin="3" rmax="4.5" z="2.5"/>)"
                      "</polycone>");
    for (const char* name : {"inner", "outer", "cone"}) place(name, "", name);
    EXPECT_EQ(run().code, 0);
    const json facts = report()["geometry"];
    EXPECT_EQ(facts["pairs"]["of_facets"], 2);
    EXPECT_EQ(facts["pairs"]["beyond_deviation"], 4);  // three in the cube; the first and the last
    EXPECT_GT(facts["deviation"], 0.001);
    EXPECT_LT(facts["deviation"], 0.002);
    place("hull", "", "hull");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(report()["clashes"].size(), 1U);
    EXPECT_EQ(report()["clashes"][0]["relation"], "equal");
}

TEST_F(ClashGdml, OverlapsWithinTheDeviationAreToldApart) {
    const std::string whole = R"( z="5" deltaphi="360" aunit="deg"/>)";
    add_solid("inner", R"(<tube name="inner" rmax="2")" + whole);
    add_solid("outer", R"(<tube name="outer" rmin="2" rmax="3")" + whole);
    place("inner", R"(<rotation z="1" unit="deg"/>)", "inner");
    place("outer", "", "outer");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(report()["clashes"].size(), 1U);
    EXPECT_EQ(report()["clashes"][0]["within_deviation"], true);
    place("inner", R"(<position x="0.1"/>)", "deep");
    EXPECT_EQ(run().code, 1);
    for (const json& clash : report()["clashes"])
        if (clash["b"] == "mother/deep") {
            EXPECT_EQ(clash["within_deviation"], false);
        }
}

TEST_F(ClashGdml, ShapesHaveTheirVolumes) {
    // Each stands in the middle of the cube with a box around it that it does not fill.
    const std::vector<std::pair<std::string, std::string>> shapes{
        {R"(<trd name="s" x1="2" x2="4" y1="2" y2="4" z="3"/>)", "28"},
        {R"(<trap name="s" z="2" theta="0" phi="0" y1="2" x1="2" x2="4" alpha1="0" y2="2" x3="2" x4="4" alpha2="0"/>)",
         "12"},
        {R"(<para name="s" x="2" y="2" z="2" alpha="0" theta="0" phi="0"/>)", "8"},
        {R"(<arb8 name="s" v1x="-1" v1y="-1" v2x="-1" v2y="1" v3x="1" v3y="1" v4x="1" v4y="-1" v5x="-2" v5y="-2" v6x="-2" v6y="2" v7x="2" v7y="2" v8x="2" v8y="-2" dz="1.5"/>)",
         "28"},
        {R"(<xtru name="s"><twoDimVertex x="0" y="0"/><twoDimVertex x="0" y="2"/><twoDimVertex x="1" y="1"/><twoDimVertex x="2" y="2"/><twoDimVertex x="2" y="0"/><section zOrder="1" zPosition="1" xOffset="0" yOffset="0" scalingFactor="1"/><section zOrder="0" zPosition="-1" xOffset="0" yOffset="0" scalingFactor="1"/></xtru>)",
         "6"},
        {R"(<polyhedra name="s" numsides="4" startphi="45" deltaphi="360" aunit="deg"><zplane rmax="2" z="0"/><zplane rmax="2" z="3"/></polyhedra>)",
         "48"},
        {R"(<scaledSolid name="s"><solidref ref="unit"/><scale x="2" y="3" z="0.5"/></scaledSolid>)",
         "3"},
        {R"(<multiUnion name="s"><multiUnionNode name="a"><solid ref="unit"/></multiUnionNode><multiUnionNode name="b"><solid ref="unit"/><position x="0.5"/></multiUnionNode></multiUnion>)",
         "3/2"}};
    for (const auto& [element, volume] : shapes) {
        solids = R"(<box name="cube" x="10" y="10" z="10"/><box name="unit" x="1" y="1" z="1"/>)";
        volumes.clear();
        placed.clear();
        add_solid("s", element);
        place("s", R"(<position x="20"/>)", "s");
        EXPECT_EQ(run().code, 1);
        EXPECT_EQ(found(), (Found{"s-mother disjoint " + volume})) << element;
    }
}

TEST_F(ClashGdml, AssembliesAreWhatTheyPlace) {
    add_solid("c", R"(<box name="c" x="2" y="2" z="2"/>)");
    volumes += R"(<assembly name="pair"><physvol><volumeref ref="c"/></physvol>)"
               R"(<physvol><volumeref ref="c"/><position y="2"/></physvol></assembly>)";
    place("pair", R"(<position x="2"/><rotation x="90" unit="deg"/>)", "p");
    place("pair", R"(<position x="3"/>)", "q");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(found(), (Found{"p/c-q/c overlapping 4"}));
    volumes += R"(<assembly name="x"><physvol><volumeref ref="y"/></physvol></assembly>)"
               R"(<assembly name="y"><physvol><volumeref ref="x"/></physvol></assembly>)";
    place("x", "", "endless");
    EXPECT_EQ(run().code, 5);
}

TEST_F(ClashGdml, ReplicasFillTheirMother) {
    // The wall and the rods of pyg4ometry's T306 and T307: rods as wide as a copy, and wider.
    add_solid("rod", R"(<box name="rod" x="2.5" y="10" z="10"/>)");
    const std::string copies =
        R"(<replicavol number="4"><volumeref ref="rod"/><replicate_along_axis><direction x="1"/>)"
        R"(<width value="2.5" unit="mm"/><offset value="0" unit="mm"/></replicate_along_axis></replicavol>)";
    placed = copies;
    EXPECT_EQ(run().code, 0);
    EXPECT_EQ(report()["geometry"]["pairs"]["compared"], 4 + 3);
    solids.replace(solids.find("2.5"), 3, "2.6");
    EXPECT_EQ(run().code, 1);
    EXPECT_EQ(found(), (Found{"rod/0-mother overlapping 5", "rod/0-rod/1 overlapping 10",
                              "rod/1-rod/2 overlapping 10", "rod/2-rod/3 overlapping 10",
                              "rod/3-mother overlapping 5"}));
    placed.replace(placed.find("x=\"1\""), 5, "rho=\"1\"");
    EXPECT_EQ(run().code, 7);
}

TEST_F(ClashGdml, DivisionsBeginAtTheirOffset) {
    add_solid("slice", R"(<box name="slice" x="10" y="2" z="10"/>)");
    add_solid("bar", R"(<box name="bar" x="1" y="4" z="1"/>)");
    const std::string end = R"(><volumeref ref="slice"/></divisionvol>)";
    place("bar", R"(<position y="3"/>)", "bar");
    // Slices from -4 to 4; the bar reaches from 1 to 5 and meets two of them in full.
    for (const char* numbers : {R"( number="4" width="2")", R"( width="2" number="4" unit="mm")"}) {
        placed = placed.substr(0, placed.find("<divisionvol"));
        placed += R"(<divisionvol axis="kYAxis" offset="1")" + std::string(numbers) + end;
        EXPECT_EQ(run().code, 1);
        EXPECT_EQ(found(), (Found{"bar-slice/2 overlapping 1", "bar-slice/3 overlapping 2"}));
    }
    for (const char* numbers : {R"( number="5")", R"( width="2")"}) {
        placed = R"(<divisionvol axis="kYAxis")" + std::string(numbers) + end;
        EXPECT_EQ(run().code, 0) << run().err;
        EXPECT_EQ(report()["geometry"]["pairs"]["compared"], 5 + 4);
    }
    for (const char* other : {R"(axis="kYAxis" number="4")", R"(axis="kPhi" number="5")"}) {
        placed = "<divisionvol " + std::string(other) + end;
        EXPECT_EQ(run().code, 7) << other;
    }
    placed = R"(<divisionvol axis="kYAxis")" + end;
    EXPECT_EQ(run().code, 3);
}

TEST_F(ClashGdml, LoopsStandForTheirTurns) {
    // Cubes of 1, 3 and 5 at 0, 3 and 6 on the x axis, and a matrix that has an index itself.
    define = R"(<variable name="i" value="1"/><constant name="last" value="5"/>)"
             R"(<matrix name="m" coldim="1" values="1 9 3 9 5"/>)";
    solids +=
        R"(<loop for="i" to="last" step="2"><box name="b[i]" x="m[i]" y="i" z="1*i"/></loop>)";
    volumes = R"(<loop for="i" to="last" step="2">)"
              R"(<volume name="b[i]"><solidref ref="b[i]"/></volume></loop>)";
    placed = R"(<loop for="i" from="1" to="last" step="2"><physvol name="p[i]">)"
             R"(<volumeref ref="b[i]"/><position x="3*(i-1)/2"/></physvol></loop>)";
    EXPECT_EQ(run().code, 1) << run().err;
    // From -0.5 to 0.5, 1.5 to 4.5 and 3.5 to 8.5.
    EXPECT_EQ(found(), (Found{"p_2-p_4 overlapping 9", "p_4-mother overlapping 175/2"}));
    const std::string inner = R"(<loop for="j" from="1" to="3" step="1">)"
                              R"(<physvol name="q[i,j]"><volumeref ref="b_0"/>)"
                              R"(<position x="i" y="j"/></physvol></loop>)";
    placed = R"(<loop for="i" from="0" to="2" step="1">)" + inner + "</loop>";
    EXPECT_EQ(run().code, 0) << run().err;
    EXPECT_EQ(report()["geometry"]["pairs"]["compared"], 9 + 12 + 8);
    for (const char* wrong :
         {R"(for="i" from="1" to="2" step="0")", R"(for="i" from="1" to="2.5" step="1")",
          R"(for="k" to="2" step="1")", R"(for="i" to="2")"}) {
        placed = "<loop " + std::string(wrong) + ">" + inner + "</loop>";
        EXPECT_EQ(run().code, 3) << wrong;
    }
    placed = R"(<loop for="i" from="1" to="999999999" step="1"><position/></loop>)";
    EXPECT_EQ(run().code, 5);
}

TEST_F(ClashGdml, WhatIsNotSupportedIsNamed) {
    add_solid("c", R"(<box name="c" x="2" y="2" z="2"/>)");
    add_solid("h", R"(<hype name="h" rmin="1" rmax="2" inst="1" outst="1" z="2"/>)");
    place("c", "", "c");
    place("h", "", "h");
    const Finished stopped = run();
    EXPECT_EQ(stopped.code, 7);
    EXPECT_NE(stopped.err.find("<hype> is not supported"), std::string::npos) << stopped.err;
    EXPECT_EQ(run({"--keep-going"}).code, 1);
    EXPECT_EQ(report()["missing"][0]["parts"][0], "mother/h");
    EXPECT_EQ(report()["is_complete"], false);
    placed = R"(<replicavol number="3"><volumeref ref="c"/></replicavol>)";
    EXPECT_EQ(run().code, 7);
    EXPECT_EQ(run({"--keep-going"}).code, 1);
}

TEST_F(ClashGdml, HostileInput) {
    place("cube", "", "c");
    EXPECT_EQ(run_text("<!DOCTYPE gdml [<!ENTITY a \"b\">]>" + text()).code, 3);
    EXPECT_EQ(run_text(text().substr(0, text().size() / 2)).code, 3);
    EXPECT_EQ(run_text("<html/>").code, 3);
    std::string deep;
    for (int i = 0; i < 1000; ++i) deep += "<define>";
    EXPECT_EQ(run_text("<gdml>" + deep).code, 5);
    for (
        const char* wrong :
        {R"(<box name="b" x="1"/>)", R"(<box name="b" x="1" y="1" z="-1"/>)",
         R"(<box name="b" x="1" y="1" z="1/0"/>)",
         R"(<box name="b" x="1" y="1" z="1" lunit="no"/>)",
         R"(<tube name="b" rmax="-1" z="1" deltaphi="1"/>)",
         R"(<union name="b"><first ref="b"/><second ref="cube"/></union>)",
         R"(<polyhedra name="b" numsides="1e9" deltaphi="360"/>)",
         R"(<tessellated name="b"><triangular vertex1="p" vertex2="q" vertex3="r"/></tessellated>)"}) {
        solids = R"(<box name="cube" x="10" y="10" z="10"/>)";
        volumes.clear();
        placed.clear();
        add_solid("b", wrong);
        place("b", "", "b");
        EXPECT_EQ(run({"--keep-going"}).code, 1) << wrong;
        EXPECT_EQ(report()["missing"].size(), 1U) << wrong;
    }
}

TEST_F(ClashGdml, AsciiIsAnEncoding) {
    EXPECT_EQ(run_text(R"(<?xml version="1.0" encoding="ASCII"?>)" + text()).code, 0);
    EXPECT_EQ(run_text(R"(<?xml version="1.0" encoding="KLINGON"?>)" + text()).code, 3);
    const std::string umlaut = "<gdml><define><constant name=\"\xc3\xa4\" value=\"1\"/></define>";
    EXPECT_EQ(run_text(R"(<?xml version="1.0" encoding="ASCII"?>)" + umlaut).code, 3);
}

TEST_F(ClashGdml, OptionsOfOtherManifests) {
    EXPECT_EQ(run({"--resume"}).code, 2);
    EXPECT_EQ(run({"--shard", "1/2"}).code, 2);
    EXPECT_EQ(run({"--facets", "5"}).code, 2);
    EXPECT_EQ(run({"--facets", "64"}).code, 0);
}

TEST_F(ClashGdml, TheExampleHasTwoClashes) {
    EXPECT_EQ(trisect({"clash", TRISECT_EXAMPLE, "-o", path("report.json"), "-o",
                       path("report.bcf"), "--volumes", "--pictures", path("pictures")})
                  .code,
              1);
    EXPECT_EQ(report()["clashes"].size(), 2U);
    EXPECT_EQ(report()["clashes"][0]["b"], "barrel/cable");
    EXPECT_EQ(report()["clashes"][0]["volume"]["value"], 6.4);
    EXPECT_EQ(report()["clashes"][1]["a"], "world/right");
}

}  // namespace
