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

class TreeCommand : public trisect::test::Scratch {
protected:
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
    std::string tool_ = box("tool.obj", {1, -1, 1}, {3, 1, 3});
    std::string far_ = box("far.obj", {10, 0, 0}, {12, 2, 2});
    std::string out_ = path("t.svg");
};

TEST_F(TreeCommand, UntouchedMeshIsOneLeaf) {
    const json document = trisect({"tree", cube_, "--assume-embedded", "--json"}).json();
    EXPECT_EQ(document["schema"], "trisect.tree/1");
    EXPECT_EQ(document["cells"]["nodes"], 1);
    EXPECT_EQ(document["cells"]["listing_leaves"], 1);
    EXPECT_EQ(document["cells"]["polygons"], 12);
    EXPECT_EQ(document["index"]["polygons"], 12);
    EXPECT_GT(document["index"]["bytes"], 0);
    EXPECT_TRUE(document["output"].is_null());
}

TEST_F(TreeCommand, OperandsThatMeetAreArranged) {
    const json document = trisect({"tree", cube_, tool_, "--op", "difference", "--json"}).json();
    EXPECT_GE(document["cells"]["arranged_leaves"], 1);
    EXPECT_GE(document["cells"]["fragments"], 1);
    EXPECT_EQ(document["op"], "difference");
}

TEST_F(TreeCommand, OperandsApartAreNotCut) {
    const json document = trisect({"tree", cube_, far_, "--assume-embedded", "--json"}).json();
    EXPECT_EQ(document["cells"]["fragments"], 0);
    EXPECT_EQ(document["index"]["polygons"], 24);
}

TEST_F(TreeCommand, DrawingShowsCellsSolidAndOperands) {
    const json document =
        trisect({"tree", cube_, tool_, "--op", "difference", "-o", out_, "--json"}).json();
    EXPECT_GE(document["slice_cells"], 1);
    const std::string svg = read(out_);
    EXPECT_TRUE(is_well_formed_xml(svg)) << svg;
    EXPECT_NE(svg.find("operands meet"), std::string::npos);
    EXPECT_EQ(entry_count(), 4U);
}

TEST_F(TreeCommand, SliceMayBePerpendicularToAnyAxis) {
    for (const char* plane : {"x", "y=0.25", "z=1.75", "z=99"}) {
        const Finished result = trisect({"tree", cube_, "--plane", plane, "-o", "-"});
        ASSERT_EQ(result.code, 0) << plane << result.err;
        EXPECT_TRUE(is_well_formed_xml(result.out)) << plane;
        EXPECT_NE(result.err.find("cell tree"), std::string::npos);
    }
}

TEST_F(TreeCommand, SlantedSlicesAndOtherFormatsAreRefused) {
    EXPECT_EQ(trisect({"tree", cube_, "--plane", "1,1,0,0"}).code, 2);
    EXPECT_EQ(trisect({"tree", cube_, "-o", path("t.png")}).code, 2);
    EXPECT_EQ(trisect({"tree", cube_, "-o", "-", "--json"}).code, 2);
}

TEST_F(TreeCommand, PageHasBothTrees) {
    const std::string page = path("page.html");
    const json document =
        trisect({"tree", cube_, tool_, "--op", "difference", "--page", page, "--json"}).json();
    EXPECT_EQ(document["op"], "difference");
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("page":"tree")"), std::string::npos);
    EXPECT_NE(text.find(R"("planes":[)"), std::string::npos);  // where the data are
    EXPECT_EQ(trisect({"tree", cube_, "-o", page, "--page", page}).code, 2);
}

}  // namespace
