// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
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

TEST_F(CheckCommand, AFileWithoutFacesIsAFinding) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
        "property float z\nelement face 0\nproperty list uchar uint vertex_indices\nend_header\n";
    for (const auto& file : {write("empty.obj", "# nothing\n"), write("empty.ply", ply),
                             write("empty.stl", "solid Empty\nendsolid Empty")}) {
        const Finished result = trisect({"check", file, "--json"});
        EXPECT_EQ(result.code, 1) << file;
        const json report = result.json();
        EXPECT_EQ(report["solid"], true) << file;
        EXPECT_EQ(report["counts"]["empty_mesh"], 1) << file;
    }
}

TEST_F(CheckCommand, RemarksOnTheFileAreFindingsWithPlaces) {
    const std::string slash = trisect::test::box_text({0, 0, 0}, {1, 1, 1});
    const std::size_t face = slash.find("\nf ");
    ASSERT_NE(face, std::string::npos);
    std::string text = slash;
    text.insert(text.find(' ', face + 3), "//");
    const Finished result = trisect({"check", write("slash.obj", text), "--json"});
    EXPECT_EQ(result.code, 1);
    const json report = result.json();
    EXPECT_EQ(report["solid"], true);
    EXPECT_EQ(report["warnings"], 0);
    ASSERT_EQ(report["remarks"].size(), 1U);
    EXPECT_EQ(report["remarks"][0]["kind"], "empty_index_field");
    EXPECT_EQ(report["remarks"][0]["line"],
              2 + std::count(text.begin(), text.begin() + static_cast<long>(face), '\n'));
    EXPECT_EQ(report["remarks"][0]["column"], 3);
}

TEST_F(CheckCommand, TextNamesTheDefects) {
    const Finished result = trisect({"check", open_box("open.obj")});
    EXPECT_NE(result.out.find("open_edge"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("not a solid"), std::string::npos) << result.out;
}

}  // namespace
