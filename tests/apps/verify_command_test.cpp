// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class VerifyCommand : public trisect::test::Scratch {
protected:
    std::string a_ = box("a.obj", {0, 0, 0}, {4, 4, 4});
    std::string b_ = box("b.obj", {2, 2, 2}, {6, 6, 6});
};

TEST_F(VerifyCommand, RightResultsEndWithZero) {
    const Finished good =
        trisect({"verify", "intersection", a_, b_, box("i.obj", {2, 2, 2}, {4, 4, 4}), "--json"});
    EXPECT_EQ(good.code, 0) << good.err;
    const json report = good.json();
    EXPECT_EQ(report["schema"], "trisect.verify/1");
    EXPECT_EQ(report["verdict"], "equal");
    EXPECT_EQ(report["radius"]["upper"], 0.0);
    EXPECT_TRUE(report["witness"].is_null());
}

TEST_F(VerifyCommand, OurOwnResultsAreRight) {
    for (const char* op : {"union", "intersection", "difference", "xor"}) {
        const std::string out = path("out.off");
        ASSERT_EQ(trisect({op, a_, b_, "-o", out}).code, 0);
        EXPECT_EQ(trisect({"verify", op, a_, b_, out}).code, 0) << op;
    }
}

TEST_F(VerifyCommand, WrongResultsHaveAWitness) {
    const Finished bad =
        trisect({"verify", "intersection", a_, b_, box("i.obj", {2, 2, 2}, {4, 4, 3}), "--json"});
    EXPECT_EQ(bad.code, 1);
    const json report = bad.json();
    EXPECT_EQ(report["verdict"], "different");
    const json witness = report["witness"];
    EXPECT_EQ(witness["point"].size(), 3U);
    EXPECT_EQ(witness["in_exact"], true);
    EXPECT_EQ(witness["in_result"], false);
    EXPECT_EQ(witness["winding_numbers"], json({1, 1, 0}));
    EXPECT_FALSE(witness["faces"].empty());
    const Finished text =
        trisect({"verify", "intersection", a_, b_, path("i.obj"), "--within", "0.5"});
    EXPECT_EQ(text.code, 1);
    EXPECT_NE(text.out.find("witness"), std::string::npos);
}

TEST_F(VerifyCommand, WithinADistance) {
    const std::string near = box("i.obj", {2, 2, 2}, {4, 4, 3});
    EXPECT_EQ(trisect({"verify", "intersection", a_, b_, near, "--within", "1.01"}).code, 0);
    EXPECT_EQ(trisect({"verify", "intersection", a_, b_, near, "--within", "0.99"}).code, 1);
    EXPECT_EQ(trisect({"verify", "intersection", a_, b_, near, "--within", "-1"}).code, 2);
}

TEST_F(VerifyCommand, ExactBoundariesAreComparedAsTheyAre) {
    const std::string tetrahedron = write("t.obj",
                                          "v 0 0 0\nv 7 0 0\nv 0 5 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string block = box("d.obj", {-1, -1, 1}, {9, 9, 9});
    const std::string exact = path("kept.exact");
    const std::string rounded = path("kept.off");
    ASSERT_EQ(
        trisect({"intersection", tetrahedron, block, "-o", rounded, "--boundary", exact}).code, 0);
    // Corners at thirds: the file of doubles is another set, the exact one is not.
    EXPECT_EQ(trisect({"verify", "intersection", tetrahedron, block, rounded}).code, 1);
    const Finished good = trisect({"verify", "intersection", tetrahedron, block, exact, "--json"});
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_EQ(good.json()["verdict"], "equal");
    EXPECT_EQ(good.json()["radius"]["upper"], 0.0);
    EXPECT_EQ(trisect({"diff", exact, exact}).code, 0);
    EXPECT_EQ(trisect({"diff", exact, rounded}).code, 1);
    // As an operand, too: what is cut off and what is kept make the whole.
    const std::string rest = path("rest.exact");
    ASSERT_EQ(
        trisect({"difference", tetrahedron, block, "-o", path("r.off"), "--boundary", rest}).code,
        0);
    EXPECT_EQ(trisect({"verify", "union", exact, rest, tetrahedron}).code, 0);
    const Finished bad = trisect({"verify", "union", exact, block, rest, "--json"});
    EXPECT_EQ(bad.code, 1);
    EXPECT_EQ(bad.json()["verdict"], "different");
    EXPECT_FALSE(bad.json()["witness"].is_null());
    // Too near for doubles: different all the same, and no witness is made up.
    const Finished near = trisect({"verify", "union", rounded, rounded, exact, "--json"});
    EXPECT_EQ(near.code, 1);
    EXPECT_EQ(near.json()["verdict"], "different");
    EXPECT_TRUE(near.json()["radius"]["upper"].is_null());
    EXPECT_TRUE(near.json()["witness"].is_null());
    EXPECT_EQ(trisect({"verify", "union", exact, rest, tetrahedron, "--within", "1"}).code, 2);
}

TEST_F(VerifyCommand, OpenResultsAreFindings) {
    const Finished open = trisect({"verify", "union", a_, b_, open_box("open.obj"), "--json"});
    EXPECT_EQ(open.code, 1);
    EXPECT_EQ(open.json()["verdict"], "not_closed");
    EXPECT_FALSE(open.json()["defects"].empty());
}

TEST_F(VerifyCommand, OpenOperandsAreNoSolids) {
    EXPECT_EQ(trisect({"verify", "union", open_box("open.obj"), b_, a_}).code, 4);
    EXPECT_EQ(trisect({"verify", "minkowski", a_, b_, a_}).code, 2);
    EXPECT_EQ(trisect({"verify", "union", a_, b_}).code, 2);
}

TEST_F(VerifyCommand, PageHasTheWitness) {
    const std::string wrong = box("i.obj", {2, 2, 2}, {4, 4, 5});
    const std::string page = path("page.html");
    const Finished result = trisect({"verify", "intersection", a_, b_, wrong, "--page", page});
    EXPECT_EQ(result.code, 1) << result.err;
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("title":"witness")"), std::string::npos) << text.substr(0, 6000);
    EXPECT_NE(text.find("winding number 0 of a.obj"), std::string::npos);
    const std::string right = box("j.obj", {2, 2, 2}, {4, 4, 4});
    EXPECT_EQ(trisect({"verify", "intersection", a_, b_, right, "--page", page}).code, 0);
    EXPECT_NE(read(page).find(R"("findings":[])"), std::string::npos);
}

}  // namespace
