// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class SplitCommand : public trisect::test::Scratch {
protected:
    json split(std::vector<std::string> options) {
        options.insert(options.begin(), "split");
        options.emplace_back("--json");
        const Finished result = trisect(options);
        EXPECT_EQ(result.code, 0) << result.err;
        return result.json();
    }
    std::string cube_ = box("cube.obj", {0, 0, 0}, {4, 4, 4});
    std::string tool_ = box("tool.obj", {3, 3, 3}, {9, 9, 9});
    std::string first_ = path("first.obj");
    std::string second_ = path("second.stl");
};

TEST_F(SplitCommand, ByAnotherSolid) {
    const json document = split({cube_, tool_, "-o", first_, second_, "--exact"});
    EXPECT_EQ(document["schema"], "trisect.split/1");
    ASSERT_EQ(document["parts"].size(), 2U);
    EXPECT_EQ(document["parts"][0]["file"], first_);
    EXPECT_EQ(document["parts"][0]["volume"], 1);
    EXPECT_EQ(document["parts"][1]["volume"], 63);
    for (const json& part : document["parts"]) EXPECT_FALSE(part["certificate"].is_null());
    EXPECT_EQ(document["inputs"].size(), 2U);
    EXPECT_EQ(trisect({"info", second_, "--json"}).json()["volume"], 63);
}

TEST_F(SplitCommand, ByPlanes) {
    const std::string third = path("third.exact");
    const json document =
        split({cube_, "--plane", "z=1", "--plane", "0,0,2,-5", "-o", first_, second_, third});
    ASSERT_EQ(document["parts"].size(), 3U);
    EXPECT_EQ(document["parts"][0]["volume"], 16);
    EXPECT_EQ(document["parts"][1]["volume"], 24);
    EXPECT_EQ(document["parts"][2]["volume"], 24);
    EXPECT_EQ(document["evaluations"], 1);
    EXPECT_EQ(trisect({"info", third, "--json"}).json()["volume"], 24);
    EXPECT_EQ(split({cube_, "--plane", "x", "-o", first_, second_})["parts"][0]["volume"], 32);
}

TEST_F(SplitCommand, APartMayBeEmpty) {
    const std::string far = box("far.obj", {10, 10, 10}, {11, 11, 11});
    const json document = split({cube_, far, "-o", first_, second_});
    EXPECT_EQ(document["parts"][0]["triangles"], 0);
    EXPECT_EQ(document["parts"][1]["volume"], 64);
    EXPECT_TRUE(exists("first.obj"));
}

TEST_F(SplitCommand, AllFilesOrNone) {
    const std::size_t before = entry_count();
    EXPECT_NE(trisect({"split", cube_, tool_, "-o", first_, path("absent/second.stl")}).code, 0);
    EXPECT_EQ(entry_count(), before);
    // Nor is a file replaced.
    static_cast<void>(write("first.obj", "kept"));
    EXPECT_NE(trisect({"split", cube_, tool_, "-o", first_, path("absent/second.stl")}).code, 0);
    std::filesystem::create_directory(path("folder.stl"));
    EXPECT_NE(trisect({"split", cube_, tool_, "-o", first_, path("folder.stl")}).code, 0);
    EXPECT_EQ(read(first_), "kept");
    EXPECT_EQ(entry_count(), before + 2);
}

TEST_F(SplitCommand, WrongRequestsAreTwo) {
    EXPECT_EQ(trisect({"split", cube_, "-o", first_, second_}).code, 2);
    EXPECT_EQ(trisect({"split", cube_, tool_, "--plane", "z", "-o", first_, second_}).code, 2);
    EXPECT_EQ(trisect({"split", cube_, "--plane", "z", "-o", first_, second_, path("c.obj")}).code,
              2);
    EXPECT_EQ(trisect({"split", cube_, tool_, "-o", first_, first_}).code, 2);
    EXPECT_EQ(trisect({"split", cube_, tool_, "-o", first_, path("no_format")}).code, 2);
    EXPECT_EQ(trisect({"split", cube_, "--plane", "0,0,0,1", "-o", first_, second_}).code, 2);
    EXPECT_EQ(trisect({"split", open_box("open.obj"), tool_, "-o", first_, second_}).code, 4);
    EXPECT_FALSE(exists("first.obj"));
}

TEST_F(SplitCommand, TheStandardOutputHoldsOneThing) {
    EXPECT_EQ(trisect({"split", cube_, tool_, "--format", "off", "-o", "-", "-"}).code, 2);
    EXPECT_EQ(
        trisect({"split", cube_, tool_, "--format", "off", "-o", "-", second_, "--json"}).code, 2);
    const Finished one = trisect({"split", cube_, tool_, "--format", "off", "-o", "-", first_});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(one.out.substr(0, 3), "OFF");
}

}  // namespace
