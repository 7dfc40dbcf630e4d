// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

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
