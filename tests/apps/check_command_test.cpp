// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class CheckCommand : public trisect::test::Scratch {};

TEST_F(CheckCommand, NothingIsFoundInABox) {
    const json report = trisect({"check", box("a.obj", {0, 0, 0}, {1, 1, 1}), "--json"}).json();
    EXPECT_EQ(report["schema"], "trisect.check/1");
    EXPECT_EQ(report["solid"], true);
    EXPECT_EQ(report["errors"], 0);
    EXPECT_EQ(report["warnings"], 0);
    EXPECT_TRUE(report["defects"].empty());
}

TEST_F(CheckCommand, OpenEdgesHavePlaces) {
    const Finished result = trisect({"check", open_box("open.obj"), "--json"});
    EXPECT_EQ(result.code, 1);
    const json report = result.json();
    EXPECT_EQ(report["solid"], false);
    EXPECT_EQ(report["counts"]["open_edge"], 4);
    ASSERT_FALSE(report["defects"].empty());
    const json first = report["defects"][0];
    EXPECT_EQ(first["severity"], "error");
    EXPECT_EQ(first["place"].size(), 3U);
    EXPECT_FALSE(first["sentence"].get<std::string>().empty());
    EXPECT_FALSE(first["vertices"].empty());
}

TEST_F(CheckCommand, ListIsAsLongAsAsked) {
    const json report = trisect({"check", open_box("open.obj"), "--json", "--places", "1"}).json();
    EXPECT_EQ(report["counts"]["open_edge"], 4);
    EXPECT_EQ(report["defects"].size(), 1U);
}

TEST_F(CheckCommand, WarningsAreFindingsOfASolid) {
    const std::string text = trisect::test::box_text({0, 0, 0}, {1, 1, 1}) + "v 9 9 9\n";
    const Finished result = trisect({"check", write("unused.obj", text), "--json"});
    EXPECT_EQ(result.code, 1);
    const json report = result.json();
    EXPECT_EQ(report["solid"], true);
    EXPECT_EQ(report["counts"]["unused_point"], 1);
}

TEST_F(CheckCommand, TextNamesTheDefects) {
    const Finished result = trisect({"check", open_box("open.obj")});
    EXPECT_NE(result.out.find("open_edge"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("not a solid"), std::string::npos) << result.out;
}

}  // namespace
