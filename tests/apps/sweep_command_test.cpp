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

class SweepCommand : public trisect::test::Scratch {
protected:
    std::string floor_ = box("floor.obj", {0, 0, 0}, {8, 8, 1});
    std::string block_ = box("block.obj", {1, 1, 3}, {2, 2, 4});
    std::string down_ = write("down.txt",
                              "# falls by four\n"
                              "1 0 0 0  0 1 0 0  0 0 1 0\n"
                              "1 0 0 0  0 1 0 0  0 0 1 -4\n");

    Finished sweep(const std::string& motion, const std::vector<std::string>& options = {}) {
        std::vector<std::string> arguments{"sweep", floor_, block_, "--motion", motion};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return trisect(arguments);
    }
};

TEST_F(SweepCommand, ContactIsAFinding) {
    const Finished result = sweep(down_);
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "contact at 0.5");
}

TEST_F(SweepCommand, DocumentHasTimeAndWitnesses) {
    const json document = sweep(down_, {"--json"}).json();
    EXPECT_EQ(document["schema"], "trisect.sweep/1");
    EXPECT_EQ(document["contact"], true);
    EXPECT_EQ(document["at_start"], "disjoint");
    EXPECT_EQ(document["pieces"], 1);
    EXPECT_EQ(document["time"]["value"], 0.5);
    EXPECT_EQ(document["time"]["lower"], "1/2");
    EXPECT_EQ(document["time"]["upper"], "1/2");
    ASSERT_EQ(document["witnesses"].size(), 4U);
    EXPECT_TRUE(document["witnesses"][0]["a"].contains("face"));
    EXPECT_TRUE(document["witnesses"][0]["b"].contains("vertex"));
    EXPECT_EQ(document["witnesses"][0]["b"]["point"][2], 3.0);
}

TEST_F(SweepCommand, ManyPosesAreOneMotion) {
    std::string text;
    for (int i = 0; i <= 300; ++i)
        text +=
            "1 0 0 " + std::to_string(i % 2) + " 0 1 0 0 0 0 1 " + std::to_string(298 - i) + "\n";
    const json document = sweep(write("many.txt", text), {"--json"}).json();
    EXPECT_EQ(document["pieces"], 300);
    EXPECT_EQ(document["time"]["value"], 300);
}

TEST_F(SweepCommand, NoContactIsNone) {
    const std::string aside =
        write("aside.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 9 0 1 0 0 0 0 1 0");
    const Finished result = sweep(aside);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, "no contact\n");
    const json document = sweep(aside, {"--json"}).json();
    EXPECT_EQ(document["contact"], false);
    EXPECT_FALSE(document.contains("time"));
}

TEST_F(SweepCommand, ScrewsAndStraightPiecesFollowEachOther) {
    // Down by two in a quarter turn: it stands on the floor, turned; then along.
    const std::string motion = write("screw.txt",
                                     "screw 1 0 0 1  1.5 1.5 0  0 0 -2\n"
                                     "screw 1 0 0 0  0 0 0  3 0 0\n");
    const json touch = sweep(motion, {"--json"}).json();
    EXPECT_EQ(touch["time"]["value"], 1.0);
    EXPECT_EQ(touch["pieces"], 2);
    EXPECT_EQ(sweep(motion, {"--until", "overlap"}).code, 0);
    const std::string deeper = write("deeper.txt",
                                     "screw 1 0 0 1  1.5 1.5 0  0 0 -2\n"
                                     "screw 1 0 0 0  0 0 0  3 0 0\n"
                                     "screw 1 0 0 0  0 0 0  0 0 -1\n");
    EXPECT_EQ(sweep(deeper, {"--until", "overlap", "--json"}).json()["time"]["value"], 2.0);
}

TEST_F(SweepCommand, BothMayMove) {
    const std::string up = write("up.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 4\n");
    EXPECT_EQ(sweep(down_, {"--motion-of-a", up, "--json"}).json()["time"]["value"], 0.25);
}

TEST_F(SweepCommand, IrrationalTimesAreBracketed) {
    // The lower edge at (2, 3) turns about the y axis; it is at height 1 where s^2 + 2 s = 2.
    const std::string turn = write("turn.txt", "screw 2 0 1 0  0 0 0  0 0 0\n");
    const json time = sweep(turn, {"--json", "--width", "1e-30"}).json()["time"];
    EXPECT_NEAR(time["value"].get<double>(), 0.7320508075688772, 1e-15);
    EXPECT_EQ(time["polynomial"], (json{"-2", "2", "1"}));
    EXPECT_NE(time["lower"], time["upper"]);
    EXPECT_EQ(sweep(turn, {"--width", "0"}).code, 2);
}

TEST_F(SweepCommand, MotionFilesWithMistakesAreRefusedWithTheirPlace) {
    const auto expect_refused = [this](const char* text, const char* place) {
        const Finished result = sweep(write("bad.txt", text));
        EXPECT_EQ(result.code, 3) << text;
        EXPECT_NE(result.err.find(place), std::string::npos) << result.err;
    };
    expect_refused("", "bad.txt");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1\n", "bad.txt:1:1");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 x\n", "bad.txt:1:23");
    expect_refused("\n1 0 0 0 0 0 0 0 0 0 1 0\n", "bad.txt:2:1");  // singular
    expect_refused("screw 0 0 0 1 0 0 0 0 0 0\n", "bad.txt:1:1");
    expect_refused("screw 1 0 0 1.5 0 0 0 0 0 0\n", "bad.txt:1:13");
    expect_refused("screw 1 0 0 1\n", "bad.txt:1:1");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 0\n-1 0 0 0 0 -1 0 0 0 0 1 0\n", "bad.txt:2:1");
    EXPECT_EQ(sweep(path("absent.txt")).code, 3);
    EXPECT_EQ(trisect({"sweep", floor_, block_}).code, 2);
}

TEST_F(SweepCommand, KeyFramesAreAnsweredByACertifiedInterval) {
    // Down by four in two seconds and a quarter turn meanwhile: it is on the floor after one.
    const std::string frames = write("frames.json", R"({"keyframes": [
            {"time": 0, "position": [1.5, 1.5, 0]},
            {"time": 2, "rotation": [1, 0, 0, 1], "position": [1.5, 1.5, -4]}]})");
    const Finished text = sweep(frames);
    EXPECT_EQ(text.code, 1) << text.err;
    EXPECT_EQ(text.out.substr(0, 18), "no contact before ");
    const json document = sweep(frames, {"--json", "--width", "1e-6"}).json();
    EXPECT_EQ(document["contact"], true);
    EXPECT_EQ(document["narrow"], true);
    EXPECT_EQ(document["duration"], 2.0);
    EXPECT_LE(document["free_until"], 1.0);
    EXPECT_GE(document["contact_by"], 1.0);
    EXPECT_NEAR(document["contact_by"].get<double>(), document["free_until"].get<double>(), 1e-6);
    EXPECT_EQ(sweep(frames, {"--until", "overlap"}).code, 2);
}

TEST_F(SweepCommand, TurnThatOnlyTouchesIsUndecided) {
    // Two turns while it stands on the floor, and a little above it.
    const std::string on = write("on.json", R"({"turn": {"angle": 12, "center": [1.5, 1.5, 0],
        "pose": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -2]}})");
    const json document = sweep(on, {"--json"}).json();
    EXPECT_TRUE(document["contact"].is_null());
    EXPECT_EQ(document["undecided"], json::array({json::array({0.0, 1.0})}));
    EXPECT_EQ(sweep(on).code, 1);
    const std::string above = write("above.json", R"({"turn": {"angle": 12, "duration": 5,
        "center": [1.5, 1.5, 0], "pose": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1.999999]}})");
    const Finished free = sweep(above);
    EXPECT_EQ(free.code, 0) << free.err;
    EXPECT_EQ(free.out, "no contact\n");
}

TEST_F(SweepCommand, MotionDocumentsWithMistakesAreRefused) {
    const auto expect_refused = [this](const char* text, const char* what) {
        const Finished result = sweep(write("bad.json", text));
        EXPECT_EQ(result.code, 3) << text;
        EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    };
    expect_refused("{", "not JSON");
    expect_refused("{}", "either keyframes or a turn");
    expect_refused(R"({"frames": []})", "'frames' is not known");
    expect_refused(R"({"keyframes": [{"time": 0}]})", "needs two");
    expect_refused(R"({"keyframes": [{"time": 0}, {"time": 0}]})", "ascend");
    expect_refused(R"({"keyframes": [{"time": 0}, {}]})", "keyframes[1]: has no time");
    expect_refused(R"({"keyframes": [{"time": 0}, {"time": 1, "rotation": [1, 0, 0]}]})",
                   "keyframes[1].rotation: must be 4 numbers");
    expect_refused(R"({"turn": {"axis": [0, 0, "up"]}})", "turn.axis[2]: must be a number");
    expect_refused(R"({"turn": {"axis": [0, 0, 0]}})", "axis");
}

TEST_F(SweepCommand, PageStopsAtTheContact) {
    const std::string page = path("page.html");
    const Finished result = sweep(down_, {"--page", page, "--frames", "3"});
    EXPECT_EQ(result.code, 1) << result.err;
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("times":[0.0,0.3333333333333333,0.5,0.6666666666666666,1.0])"),
              std::string::npos)
        << text.substr(0, 6000);
    EXPECT_NE(text.find(R"("contact":2)"), std::string::npos);
    EXPECT_NE(text.find("face meets vertex"), std::string::npos);
    EXPECT_EQ(sweep(down_, {"--page", page, "--frames", "0"}).code, 2);
}

}  // namespace
