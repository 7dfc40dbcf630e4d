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

class LocateCommand : public trisect::test::Scratch {
protected:
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
    /// The word of each line of the answer, without numbers.
    std::vector<std::string> words(const std::vector<std::string>& options,
                                   const std::string& input = {}) {
        std::vector<std::string> arguments{"locate", cube_};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Finished result = trisect(arguments, {input, {}});
        EXPECT_EQ(result.code, 0) << result.err;
        std::vector<std::string> out;
        std::string line;
        for (const char c : result.out) {
            if (c != '\n') {
                line += c;
                continue;
            }
            out.push_back(line.substr(0, line.find(' ')));
            line.clear();
        }
        return out;
    }
};

TEST_F(LocateCommand, ALineAPoint) {
    const std::string points = write("p.txt",
                                     "1 1 1\n3 1 1\n1 1 2   # on the lid\n\n"
                                     "2, 2, 1\n0\t0\t0\n1 1 1.9999999999999998\n");
    const std::vector<std::string> expected{"inside", "outside", "face",
                                            "edge",   "vertex",  "inside"};
    EXPECT_EQ(words({"--points", points}), expected);
}

TEST_F(LocateCommand, PointsOfTheCommandLineComeFirst) {
    const std::vector<std::string> expected{"outside", "vertex", "inside"};
    EXPECT_EQ(words({"--point", "-1,0,0", "--point", "2,2,2", "--points", "-"}, "1 1 1\n"),
              expected);
}

TEST_F(LocateCommand, NumbersNearZeroAreTheNearestDoubles) {
    const std::string points = write("p.txt",
                                     "1e-400 1 1\n1 1 -1e-9999999999999999999\n1e-320 1 1\n"
                                     "3e-324 1 1\n2e-324 1 1\n-5e-324 1 1\n");
    const std::vector<std::string> expected{"face", "face", "inside", "inside", "face", "outside"};
    EXPECT_EQ(words({"--points", points}), expected);
    EXPECT_EQ(words({"--point", "1e-400,1,1"}), std::vector<std::string>{"face"});
    for (const char* text : {"1 1 1\n1 1e400 1\n", "1 1 1\n1 -1e+400 1\n", "1 1 1\n1 inf 1\n"}) {
        const Finished result = trisect({"locate", cube_, "--points", "-"}, {text, {}});
        EXPECT_EQ(result.code, 3);
        EXPECT_NE(result.err.find("standard input:2:3"), std::string::npos) << result.err;
    }
}

TEST_F(LocateCommand, LastLineNeedsNoEnd) {
    EXPECT_EQ(words({"--points", "-"}, "1 1 1").size(), 1U);
    EXPECT_TRUE(words({"--points", "-"}, "# nothing\n").empty());
}

TEST_F(LocateCommand, SameEntityHasTheSameNumber) {
    const Finished result = trisect({"locate", cube_, "--point", "0.5,0.5,2", "--point",
                                     "1.5,1.75,2", "--point", "1,1,0", "--json"});
    const json points = result.json()["points"];
    EXPECT_EQ(points[0]["location"], "face");
    EXPECT_EQ(points[0]["face"], points[1]["face"]);
    EXPECT_NE(points[0]["face"], points[2]["face"]);
    EXPECT_EQ(points[0]["sources"][0]["input"], 0);
}

TEST_F(LocateCommand, DocumentCountsAndNamesSources) {
    const std::string other = box("other.obj", {2, 0, 0}, {3, 1, 1});
    const json document = trisect({"locate", cube_, other, "--op", "union", "--point", "3,0.5,0.5",
                                   "--point", "0,1,1", "--point", "1,1,1", "--json"})
                              .json();
    EXPECT_EQ(document["schema"], "trisect.locate/1");
    EXPECT_EQ(document["counts"]["face"], 2);
    EXPECT_EQ(document["counts"]["inside"], 1);
    EXPECT_EQ(document["counts"]["outside"], 0);
    EXPECT_EQ(document["points"][0]["sources"][0]["input"], 1);
    EXPECT_EQ(document["points"][1]["sources"][0]["input"], 0);
    EXPECT_EQ(document["points"][2]["location"], "inside");
}

TEST_F(LocateCommand, WhereOperandsTouchedIsInside) {
    const std::string other = box("other.obj", {2, 0, 0}, {4, 2, 2});
    const json document =
        trisect({"locate", cube_, other, "--op", "union", "--point", "2,1,1", "--json"}).json();
    EXPECT_EQ(document["points"][0]["location"], "inside");
}

TEST_F(LocateCommand, MistakesInFilesHavePlaces) {
    const std::vector<std::pair<std::string, int>> mistakes{
        {"1 1 1\n1 1\n", 3}, {"1 1 1\n1 x 1\n", 3}, {"1 1 1\n1 1 1 1\n", 7}, {"\n1 nan 1\n", 3}};
    for (const auto& [text, column] : mistakes) {
        const Finished result =
            trisect({"locate", cube_, "--points", write("p.txt", text), "--json"});
        EXPECT_EQ(result.code, 3) << text;
        const json error = result.json()["error"];
        EXPECT_EQ(error["file"], path("p.txt")) << text;
        EXPECT_EQ(error["line"], 2) << text;
        EXPECT_EQ(error["column"], column) << text;
    }
    EXPECT_EQ(trisect({"locate", cube_, "--points", path("none.txt")}).code, 3);
}

TEST_F(LocateCommand, MistakesOfTheCommandLine) {
    EXPECT_EQ(trisect({"locate", cube_}).code, 2);
    EXPECT_EQ(trisect({"locate", cube_, "--point", "1,2"}).code, 2);
    EXPECT_EQ(trisect({"locate", "-", "--points", "-"}).code, 2);
    EXPECT_EQ(trisect({"locate", open_box("open.obj"), "--point", "0,0,0"}).code, 4);
}

}  // namespace
