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
using trisect::test::trisect;

class CompareHierarchiesCommand : public trisect::test::Scratch {
protected:
    std::string floor_ = box("floor.obj", {0, 0, 0}, {8, 8, 1});
    std::string block_ = box("block.obj", {1, 1, 3}, {2, 2, 4});
    std::string down_ = write("down.txt",
                              "1 0 0 0  0 1 0 0  0 0 1 0\n"
                              "1 0 0 0  0 1 0 0  0 0 1 -4\n");

    Finished compare(const std::vector<std::string>& options) {
        std::vector<std::string> arguments{
            "compare-hierarchies", floor_, block_,        "--motion", down_, "--frames", "5",
            "--structure",         "aabb", "--structure", "obb"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return trisect(arguments);
    }
};

TEST_F(CompareHierarchiesCommand, TableHasARowForEachStructureAndQuestion) {
    const Finished result = compare({});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("5 frames: contains 1 disjoint 2 touching 2;"), std::string::npos)
        << result.out;
    for (const char* row : {"| aabb | faces |", "| aabb | distance |", "| obb | faces |"})
        EXPECT_NE(result.out.find(row), std::string::npos) << result.out;
}

TEST_F(CompareHierarchiesCommand, DocumentHasCountersAndTimes) {
    const json document = compare({"--json"}).json();
    EXPECT_EQ(document["schema"], "trisect.compare-hierarchies/1");
    EXPECT_EQ(document["frames"], 5);
    ASSERT_EQ(document["structures"].size(), 2U);
    const json& boxes = document["structures"][0];
    EXPECT_EQ(boxes["name"], "aabb");
    EXPECT_GT(boxes["bytes"], 0);
    EXPECT_EQ(boxes["faces"]["updates"], 5 * 23);
    EXPECT_GT(boxes["faces"]["measured_seconds"], 0);
    EXPECT_GT(boxes["distance"]["predicted_seconds"], 0);
}

TEST_F(CompareHierarchiesCommand, ChartIsAnSvgFile) {
    const std::string chart = path("chart.svg");
    EXPECT_EQ(compare({"--svg", chart}).code, 0);
    EXPECT_NE(read(chart).find("<svg"), std::string::npos);
}

TEST_F(CompareHierarchiesCommand, UnknownStructuresAndBadNumbersAreUsageErrors) {
    EXPECT_EQ(compare({"--structure", "treap"}).code, 2);
    EXPECT_EQ(compare({"--frames", "1"}).code, 2);
    EXPECT_EQ(compare({"--svg", "chart.png"}).code, 2);
}

TEST_F(CompareHierarchiesCommand, PageHasVolumesAndCountsOfEachFrame) {
    const std::string page = path("page.html");
    EXPECT_EQ(compare({"--page", page}).code, 0);
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("page":"hierarchies")"), std::string::npos);
    EXPECT_NE(text.find(R"("volumes":"boxes")"), std::string::npos);
    EXPECT_EQ(compare({"--page", path("page.svg")}).code, 2);
}

}  // namespace
