// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class InterfereCommand : public trisect::test::Scratch {
protected:
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});

    [[nodiscard]] std::string shifted(std::string_view name, const std::string& x,
                                      const std::string& y = "0",
                                      const std::string& z = "0") const {
        return write(name, "1 0 0 " + x + "\n0 1 0 " + y + "\n0 0 1 " + z + "\n");
    }
    /// Of the cube to a copy of it under the pose.
    [[nodiscard]] std::string relation(const std::string& pose) const {
        const Finished result = trisect({"interfere", cube_, cube_, "--pose-b", pose});
        EXPECT_EQ(result.code, result.out == "disjoint\n" ? 0 : 1) << result.err;
        return result.out;
    }
};

TEST_F(InterfereCommand, SixRelations) {
    const std::string small = box("small.obj", {0, 0, 0}, {1, 1, 2});
    EXPECT_EQ(relation(shifted("p", "2.0000000000000004")), "disjoint\n");
    EXPECT_EQ(relation(shifted("p", "2")), "touching\n");
    EXPECT_EQ(relation(shifted("p", "1.9999999999999998")), "overlapping\n");
    EXPECT_EQ(relation(shifted("p", "0")), "equal\n");
    EXPECT_EQ(trisect({"interfere", small, cube_}).out, "inside\n");
    EXPECT_EQ(trisect({"interfere", cube_, small}).out, "contains\n");
}

TEST_F(InterfereCommand, PosesTurnMirrorAndScale) {
    // A quarter turn about z and the mirror in x put the cube beside itself.
    EXPECT_EQ(relation(write("p", "0 -1 0 0\n1 0 0 0\n0 0 1 0\n")), "touching\n");
    EXPECT_EQ(relation(write("p", "-1 0 0 0\n0 1 0 0\n0 0 1 0\n")), "touching\n");
    EXPECT_EQ(relation(write("p", "-1 0 0 2\n0 1 0 0\n0 0 1 0\n")), "equal\n");
    EXPECT_EQ(relation(write("p", "0.5 0 0 0\n0 0.5 0 0\n0 0 0.5 0\n")), "contains\n");
    // Both posed alike is neither posed.
    const std::string odd = write("q", "0.1 3 0 7\n-3 0.1 0 0.3\n0 0 3 0\n");
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--pose-a", odd, "--pose-b", odd}).out,
              "equal\n");
}

TEST_F(InterfereCommand, NumbersOfAPoseMayBeOnOneLineAndOnTheStandardInput) {
    const std::string text = "1 0 0 2 0 1 0 2 0 0 1 2";
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--pose-a", "-"}, {text, {}}).out, "touching\n");
    EXPECT_EQ(trisect({"interfere", cube_, "-", "--pose-a", "-"}, {text, {}}).code, 2);
}

TEST_F(InterfereCommand, DocumentNamesWhatMeets) {
    const json document =
        trisect({"interfere", cube_, cube_, "--pose-b", shifted("p", "2", "1"), "--json"}).json();
    EXPECT_EQ(document["schema"], "trisect.interfere/1");
    EXPECT_EQ(document["relation"], "touching");
    EXPECT_EQ(document["poses"][0], json({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_EQ(document["poses"][1], json({1, 0, 0, 2, 0, 1, 0, 1, 0, 0, 1, 0}));
    EXPECT_EQ(document["inputs"].size(), 2U);
    // The faces x = 2 of A and x = 0 of B share half of their area.
    std::size_t areas = 0;
    for (const json& contact : document["contacts"]) {
        if (contact["dimension"] != 2) continue;
        ++areas;
        EXPECT_TRUE(contact["a"].contains("face"));
        EXPECT_TRUE(contact["a"].contains("source"));
        EXPECT_TRUE(contact["b"].contains("face"));
        EXPECT_EQ(contact["opposite"], true);
    }
    EXPECT_EQ(areas, 1U);
}

TEST_F(InterfereCommand, ACornerOnACorner) {
    const json document =
        trisect({"interfere", cube_, cube_, "--pose-b", shifted("p", "2", "2", "2"), "--json"})
            .json();
    ASSERT_EQ(document["contacts"].size(), 1U);
    const json contact = document["contacts"][0];
    EXPECT_EQ(contact["dimension"], 0);
    EXPECT_EQ(contact["a"]["point"], json({2, 2, 2}));
    EXPECT_EQ(contact["b"]["point"], json({0, 0, 0}));
}

TEST_F(InterfereCommand, ContactsAsText) {
    const Finished result =
        trisect({"interfere", cube_, cube_, "--pose-b", shifted("p", "2", "2", "2"), "--contacts"});
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(result.out.find("touching\nvertex "), 0U) << result.out;
    EXPECT_NE(result.out.find("of B: points\n"), std::string::npos) << result.out;
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--pose-b", shifted("p", "3"), "--contacts"}).out,
              "disjoint\n");
}

TEST_F(InterfereCommand, SelfIntersectingInputsAreResolvedFirst) {
    // Two boxes in one file that overlap: between them there is nothing but inside.
    const std::string both =
        write("both.obj", trisect::test::box_text({0, 0, 0}, {3, 2, 2}) +
                              trisect::test::box_text({1, 0, 0}, {5, 2, 2}, 9));
    const std::string whole = box("whole.obj", {0, 0, 0}, {5, 2, 2});
    EXPECT_EQ(trisect({"interfere", both, whole}).out, "equal\n");
}

TEST_F(InterfereCommand, DistanceIsAnIntervalWithTheClosestFeatures) {
    const json document = trisect({"interfere", cube_, cube_, "--pose-b",
                                   shifted("p", "5", "6", "0.5"), "--distance", "--json"})
                              .json();
    // Edges (2, 2, z) and (5, 6, z) are 5 apart.
    const json distance = document["distance"];
    EXPECT_LE(distance["lower"].get<double>(), 5);
    EXPECT_GE(distance["upper"].get<double>(), 5);
    EXPECT_LT(distance["upper"].get<double>() - distance["lower"].get<double>(), 1e-12);
    EXPECT_EQ(document["relation"], "disjoint");
    EXPECT_NEAR(distance["on_a"][0].get<double>(), 2, 1e-9);
    EXPECT_NEAR(distance["on_b"][1].get<double>(), 6, 1e-9);
}

TEST_F(InterfereCommand, NearerThanIsDecidedExactly) {
    const std::string pose = shifted("p", "5", "6");
    const auto nearer = [&](const char* than) {
        const Finished result =
            trisect({"interfere", cube_, cube_, "--pose-b", pose, "--nearer-than", than, "--json"});
        EXPECT_EQ(result.code, result.json()["nearer"] == true ? 1 : 0);
        return result.json()["nearer"];
    };
    EXPECT_EQ(nearer("5"), false);
    EXPECT_EQ(nearer("5.000000000000001"), true);
    EXPECT_EQ(nearer("0"), false);
    // Solids that meet are nearer than anything.
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--nearer-than", "0"}).out,
              "equal\nnearer than 0\n");
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--nearer-than", "-1"}).code, 2);
}

TEST_F(InterfereCommand, MistakesInPoseFilesHavePlaces) {
    struct Mistake {
        std::string text;
        int line;
        int column;
    };
    const std::vector<Mistake> mistakes{{"1 0 0 0\n0 1 0 0\n0 0 1\n", 4, 1},
                                        {"1 0 0 0\n0 x 0 0\n0 0 1 0\n", 2, 3},
                                        {"1 0 0 inf\n0 1 0 0\n0 0 1 0\n", 1, 7},
                                        {"1 0 0 0\n0 1 0 0\n0 0 1 0\n 7", 4, 2},
                                        {"1 0 0 0\n0 1 0 0\n0 1 0 0\n", 1, 1}};
    for (const auto& [text, line, column] : mistakes) {
        const Finished result =
            trisect({"interfere", cube_, cube_, "--pose-b", write("p", text), "--json"});
        EXPECT_EQ(result.code, 3) << text;
        const json error = result.json()["error"];
        EXPECT_EQ(error["file"], path("p")) << text;
        EXPECT_EQ(error["line"], line) << text;
        EXPECT_EQ(error["column"], column) << text;
    }
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--pose-b", path("none")}).code, 3);
}

TEST_F(InterfereCommand, PosesThatNeedTooManyBitsHitALimit) {
    const std::string wide = shifted("p", "1e300", "1e-300");
    const Finished result = trisect({"interfere", cube_, cube_, "--pose-b", wide});
    EXPECT_EQ(result.code, 5);
    EXPECT_NE(result.err.find("447"), std::string::npos) << result.err;
}

TEST_F(InterfereCommand, MistakesOfTheCommandLine) {
    EXPECT_EQ(trisect({"interfere", cube_}).code, 2);
    EXPECT_EQ(trisect({"interfere", cube_, cube_, cube_}).code, 2);
    EXPECT_EQ(trisect({"interfere", cube_, open_box("open.obj")}).code, 4);
}

TEST_F(InterfereCommand, PageHasBothSolidsAndWhatTheyShare) {
    const std::string page = path("page.html");
    const Finished result =
        trisect({"interfere", cube_, cube_, "--pose-b", shifted("p", "2"), "--page", page});
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_EQ(result.out, "touching\n");
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("summary":["touching","9 contacts; 1 areas, 0 segments, 0 points"])"),
              std::string::npos)
        << text.substr(0, 6000);
    EXPECT_NE(text.find("area, face to face"), std::string::npos);
    EXPECT_EQ(text.substr(text.size() - 8), "</html>\n");
}

TEST_F(InterfereCommand, PageIsAFileOfItsOwn) {
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--page", "-"}).code, 2);
    EXPECT_EQ(trisect({"interfere", cube_, cube_, "--page", path("page.png")}).code, 2);
}

}  // namespace
