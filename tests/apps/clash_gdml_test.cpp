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
