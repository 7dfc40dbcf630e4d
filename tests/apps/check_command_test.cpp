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

TEST_F(CheckCommand, ExactBoundaries) {
    const std::string exact = path("a.exact");
    ASSERT_EQ(
        trisect({"difference", box("a.obj", {0, 0, 0}, {9, 9, 9}),
                 box("b.obj", {3, 3, 3}, {5, 5, 5}), "-o", path("a.off"), "--boundary", exact})
            .code,
        0);
    const Finished cavity = trisect({"check", exact, "--json"});
    EXPECT_EQ(cavity.code, 0) << cavity.out;
    EXPECT_EQ(cavity.json()["solid"], true);
    // Two cubes that overlap, listed as one boundary.
    const auto cube = [](int first, int low, int high, std::string& planes, std::string& points,
                         std::string& faces) {
        const int p = first == 0 ? 0 : 6;
        for (int axis = 0; axis < 3; ++axis) {
            const auto normal = [&](int sign) {
                std::string text;
                for (int k = 0; k < 3; ++k) text += k == axis ? std::to_string(sign) + " " : "0 ";
                return text;
            };
            planes += normal(-1) + std::to_string(low) + "\n";
            planes += normal(1) + std::to_string(-high) + "\n";
        }
        for (int i = 0; i < 8; ++i) {
            points += "p";
            for (int k = 0; k < 3; ++k)
                points += " " + std::to_string(((i >> k) & 1) != 0 ? high : low);
            points += "\n";
        }
        const int corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
        for (int f = 0; f < 6; ++f) {
            faces += std::to_string(p + f) + " 0 " + std::to_string(p + f) + " 1 4";
            for (const int c : corners[f]) faces += " " + std::to_string(first + c);
            faces += "\n";
        }
    };
    std::string planes;
    std::string points;
    std::string faces;
    cube(0, 0, 4, planes, points, faces);
    const auto text = [&](const std::string& n6, const std::string& n8) {
        return "trisect-exact 1\nlattice 0\nplanes " + n6 + "\n" + planes + "vertices " + n8 +
               "\n" + points + "faces " + n6 + "\n" + faces;
    };
    EXPECT_EQ(trisect({"check", write("one.exact", text("6", "8"))}).code, 0);
    cube(8, 2, 6, planes, points, faces);
    const Finished crossing = trisect({"check", write("two.exact", text("12", "16")), "--json"});
    EXPECT_EQ(crossing.code, 1) << crossing.err;
    EXPECT_EQ(crossing.json()["solid"], false);
    EXPECT_EQ(crossing.json()["counts"]["self_intersection"], 1);
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

TEST_F(CheckCommand, PageHasDefectsAtTheirPlaces) {
    const std::string open = write("open.off",
                                   "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                   "3 0 2 1\n3 0 1 3\n3 0 3 2\n");
    const std::string page = path("page.html");
    const Finished result = trisect({"check", open, "--page", page});
    EXPECT_EQ(result.code, 1) << result.err;
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("title":"open edge")"), std::string::npos) << text.substr(0, 6000);
    EXPECT_NE(text.find(R"("segments":[[)"), std::string::npos);
    EXPECT_NE(text.find("not a solid; 3 errors"), std::string::npos);
}

}  // namespace
