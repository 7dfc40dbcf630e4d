// SPDX-License-Identifier: Apache-2.0
//
// A block of 20 by 20 by 10, a square tool of 2 by 2 by 8 and a square holder above it, so that
// removed volumes are whole numbers and what is flush is flush exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "picture.h"
#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;
using trisect::test::Waiting;

class MillCommand : public trisect::test::Scratch {
protected:
    std::string stock_ = box("stock.obj", {0, 0, 0}, {20, 20, 10});
    std::string tool_ = box("tool.obj", {-1, -1, 0}, {1, 1, 8});
    std::string holder_ = box("holder.obj", {-3, -3, 8}, {3, 3, 12});

    [[nodiscard]] std::vector<std::string> arguments(
        const std::string& path, const std::vector<std::string>& options = {}) const {
        std::vector<std::string> out{"mill", stock_, tool_, holder_, "--path", path};
        out.insert(out.end(), options.begin(), options.end());
        return out;
    }
    [[nodiscard]] Finished mill(const std::string& gcode,
                                const std::vector<std::string>& options = {}) const {
        return trisect(arguments(write("path.nc", gcode), options));
    }
    [[nodiscard]] json document(const std::string& gcode,
                                std::vector<std::string> options = {}) const {
        options.emplace_back("--json");
        return mill(gcode, options).json();
    }
    static std::string slot(const std::string& z) {
        return "G0 X-5 Y10\nG0 Z" + z + "\nG1 X25 F600\n";
    }
    /// Many short cuts.
    static std::string raster() {
        std::string out = "G0 X-2 Y1 Z8\nF1000\n";
        for (int row = 0; row < 10; ++row) {
            for (int i = 0; i < 22; ++i)
                out += "G1 X" + std::to_string(row % 2 == 0 ? i : 20 - i) + "\n";
            out += "Y" + std::to_string(3 + 2 * row) + "\n";
        }
        return out;
    }
};

TEST_F(MillCommand, SlotHasItsVolumeAndTime) {
    const Finished text = mill(slot("8"));
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(text.out, "no collision in 2 steps\n");
    const json d = document(slot("8"));
    EXPECT_EQ(d["schema"], "trisect.mill/1");
    EXPECT_EQ(d["removed"], 20 * 2 * 2);
    EXPECT_EQ(d["stock_volume"], 20 * 20 * 10);
    EXPECT_EQ(d["path"]["seconds"], 3.0);
    EXPECT_EQ(d["steps_done"], 2);
    EXPECT_TRUE(d["finished"]);
    EXPECT_TRUE(d["collisions"].empty());
}

TEST_F(MillCommand, HolderInTheStockIsNamedWithStepPlaceAndFaces) {
    const Finished text = mill("G0 X-5 Y10 Z1\nG1 X4 F600\nX8\n", {"-o", path("left.off")});
    EXPECT_EQ(text.code, 1) << text.err;
    EXPECT_EQ(text.out.substr(0, text.out.find('\n')),
              "collision at step 2 of 3, line 2, 0.90 s: the holder meets the stock (holder in "
              "stock, overlapping)");
    EXPECT_TRUE(exists("left.off"));
    const std::string up = "G0 X-5 Y10\nG0 Z1\nG1 X4 F600\nX8\nX12\n";
    const json d = document(up);
    EXPECT_EQ(d["steps_done"], 2);
    ASSERT_EQ(d["collisions"].size(), 1U);
    const json& c = d["collisions"][0];
    EXPECT_EQ(c["position"], (json{4.0, 10.0, 1.0}));
    EXPECT_EQ(c["common_volume"], 6 * 6 * 1);
    EXPECT_GT(c["contact_count"], 0);
    EXPECT_EQ(document(up, {"--keep-going"})["collisions"].size(), 3U);
}

TEST_F(MillCommand, HolderOnTheStockTouches) {
    EXPECT_EQ(mill(slot("2")).code, 0);
    const std::string short_slot = "G0 X-5 Y10\nG0 Z2\nG1 X5 F600\n";
    EXPECT_EQ(mill(short_slot).code, 0);
    const json d = document(short_slot, {"--touch"});
    ASSERT_EQ(d["collisions"].size(), 1U);
    EXPECT_EQ(d["collisions"][0]["relation"], "touching");
    EXPECT_TRUE(d["collisions"][0].contains("place"));
}

TEST_F(MillCommand, RapidMoveThroughTheStockIsFound) {
    const json d = document("G0 X-5 Y10 Z8\nG0 X25\n");
    ASSERT_EQ(d["collisions"].size(), 1U);
    EXPECT_EQ(d["collisions"][0]["kind"], "rapid through stock");
    EXPECT_EQ(d["collisions"][0]["step"], 2);
    EXPECT_EQ(d["collisions"][0]["common_volume"], 80);
    EXPECT_EQ(d["removed"], 0);
}

TEST_F(MillCommand, RapidRetractionSlidesAlongWhatWasCut) {
    const json d = document("G0 X10 Y10 Z20\nG1 Z5 F300\nX12 Y13\nG0 Z20\nX0\n");
    EXPECT_TRUE(d["collisions"].empty());
    // The hull of two squares of 4 less what is above the block.
    EXPECT_EQ(d["removed"], (4 + 2 * (2 + 3)) * 5);
}

TEST_F(MillCommand, FixturesAreForToolAndHolder) {
    const std::string clamp = box("clamp.obj", {9, 8, 9}, {11, 12, 12});
    const json d = document(slot("8"), {"--fixture", clamp});
    ASSERT_EQ(d["collisions"].size(), 1U);
    EXPECT_EQ(d["collisions"][0]["kind"], "tool in fixture");
    EXPECT_EQ(d["collisions"][0]["b"], clamp);
    const std::string beside = box("beside.obj", {24, 12, 15}, {26, 14, 18});
    EXPECT_EQ(
        document(slot("8"), {"--fixture", clamp, "--fixture", beside, "--keep-going"})["collisions"]
            .size(),
        2U);
}

TEST_F(MillCommand, HolderIsCheckedBetweenTheEndsOfMoves) {
    const std::string post = box("post.obj", {9, 12, 17}, {11, 13, 19});
    EXPECT_EQ(mill(slot("8"), {"--fixture", post, "--ends-only"}).code, 0);
    const json d = document(slot("8"), {"--fixture", post});
    ASSERT_EQ(d["collisions"].size(), 1U);
    EXPECT_EQ(d["collisions"][0]["kind"], "holder through fixture");
    EXPECT_EQ(document(slot("1"))["collisions"][0]["kind"], "holder through stock");
    EXPECT_EQ(mill(slot("1"), {"--ends-only"}).code, 0);
}

TEST_F(MillCommand, ArcsAreChordsWithinTheDeviation) {
    const std::string by_center = "G0 X4 Y10 Z8\nG2 X16 I6 J0 F500\n";
    const json fine = document(by_center);
    EXPECT_EQ(fine["path"]["arcs"], 1);
    EXPECT_EQ(fine["path"]["steps"], 1 + 28);
    EXPECT_EQ(document("G0 X4 Y10 Z8\nG2 X16 R6 F500\n")["path"]["steps"], 29);
    EXPECT_EQ(document(by_center, {"--chord", "1"})["path"]["steps"], 1 + 3);
    EXPECT_EQ(document("G0 X4 Y10 Z8\nG3 I6 F500\n", {"--chord", "1"})["path"]["steps"], 1 + 6);
    EXPECT_EQ(document("G18\nG0 X4 Y10 Z9\nG2 X16 I6 F500\n", {"--chord", "1"})["path"]["steps"],
              4);
}

TEST_F(MillCommand, InchesAndRelativeMoves) {
    const json d = document("g20 g0 x0 y0 z1 (air)\ng91\nn20 g1 x.5 f10 ; along\nM2\nnothing\n");
    EXPECT_EQ(d["path"]["steps"], 2);
    EXPECT_NEAR(d["path"]["seconds"].get<double>(), 3, 1e-6);
}

TEST_F(MillCommand, MistakesInProgramsAreRefusedWithTheirPlace) {
    const auto expect_refused = [this](const char* text, const char* place) {
        const Finished result = mill(text);
        EXPECT_EQ(result.code, 3) << text;
        EXPECT_NE(result.err.find(place), std::string::npos) << result.err;
    };
    expect_refused("", "path.nc");
    expect_refused("G0 X0 Y0 Z20\nG1 X1 G43\n", "path.nc:2:7");
    expect_refused("G0 X0 Y0 Z20\nG1 X1 X2\n", "path.nc:2:7");
    expect_refused("G0 X0 Y0 Z20\n  Q5\n", "path.nc:2:3");
    expect_refused("G0 X0 Y0 Z20\nG1 X\n", "path.nc:2:4");
    expect_refused("G0 X0 Y0 Z20\nG1 (X\n", "path.nc:2:4");
    expect_refused("G0 X0 Y0 Z20\n#1=2\n", "path.nc:2:1");
    expect_refused("X0 Y0 Z20\n", "path.nc:1:1");
    expect_refused("G1 X0 Y0 Z20\n", "path.nc:1:1");
    expect_refused("G0 X0 Y0 Z20\nG2 X5\n", "path.nc:2:1");
    expect_refused("G0 X0 Y0 Z20\nG2 X5 I1\n", "path.nc:2:1");
    expect_refused("G0 X0 Y0 Z20\nG2 X5 R1\n", "path.nc:2:1");
    expect_refused("G0 X0 Y0 Z20\nG1 X1 F0\n", "path.nc:2");
    expect_refused("G0 X0 Y0 Z20\nX1\nM6\n", "path.nc:3:1");
    EXPECT_EQ(trisect(arguments(path("absent.nc"))).code, 3);
}

TEST_F(MillCommand, PosesTurnTheTool) {
    // Lies along x, and goes down beside the block and through it.
    const std::string lines =
        "rapid 1 0 0 -9  0 1 0 10  0 0 1 20\n"
        "rapid 0 0 1 -9  0 1 0 10  -1 0 0 20\n"
        "0 0 1 -5  0 1 0 10  -1 0 0 20   # nearer\n"
        "0 0 1 -5  0 1 0 10  -1 0 0 8\n";
    const std::string poses = write("path.poses", lines);
    const json d = trisect(arguments(poses, {"--json"})).json();
    EXPECT_EQ(d["path"]["orientations"], 2);
    EXPECT_EQ(d["removed"], 3 * 2 * 3);
    ASSERT_EQ(d["collisions"].size(), 1U);  // the holder lies along x too
    const auto expect_refused = [&](const char* text, int code, const char* place) {
        const Finished result = trisect(arguments(write("bad.poses", text)));
        EXPECT_EQ(result.code, code) << text;
        EXPECT_NE(result.err.find(place), std::string::npos) << result.err;
    };
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 20\n0 0 1 0 0 1 0 0 -1 0 0 20\n", 7, "bad.poses:2:1");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 20\n1 0 0 0 0 1 0 0 0 0 2 20\n", 3, "bad.poses:2:1");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 20\n1 0 0 0 0 1 0 0 0 0 1\n", 3, "bad.poses:2");
    expect_refused("1 0 0 0 0 1 0 0 0 0 1 20\n", 3, "needs two poses");
}

TEST_F(MillCommand, ToolsAreMadeOfConvexShells) {
    const std::string two =
        write("two.obj", trisect::test::box_text({-1, -1, 0}, {1, 1, 8}) +
                             trisect::test::box_text({-2, -2, 2}, {2, 2, 8}, 9));
    tool_ = two;
    EXPECT_EQ(document(slot("8"))["removed"], 20 * 2 * 2);
    EXPECT_EQ(document(slot("6"))["removed"], 20 * (2 * 2 + 4 * 2));
    // An L. Of the holder, too.
    const std::string bent = path("bent.off");
    ASSERT_EQ(trisect({"union", box("b1.obj", {-1, -1, 0}, {1, 1, 8}),
                       box("b2.obj", {-1, -1, 4}, {5, 1, 8}), "-o", bent})
                  .code,
              0);
    tool_ = bent;
    const Finished result = mill(slot("8"));
    EXPECT_EQ(result.code, 7);
    EXPECT_NE(result.err.find("not convex"), std::string::npos) << result.err;
    tool_ = two;
    holder_ = bent;
    EXPECT_EQ(mill("G0 X50 Y0 Z0\nX60\n").code, 7);
    EXPECT_EQ(mill("G0 X50 Y0 Z0\nX60\n", {"--ends-only"}).code, 0);
}

TEST_F(MillCommand, StoppedRunsGoOnToTheSameBytes) {
    const std::string path_file = write("raster.nc", raster());
    const std::string whole = path("whole.off");
    const std::string resumed = path("resumed.off");
    const std::string checkpoint = path("checkpoint.json");
    ASSERT_EQ(trisect(arguments(path_file, {"-o", whole})).code, 0);
    for (const int signal : {SIGINT, SIGKILL}) {
        std::filesystem::remove(checkpoint);
        Waiting waiting(arguments(path_file, {"-o", resumed, "--checkpoint", checkpoint,
                                              "--checkpoint-seconds", "0.001"}));
        while (!std::filesystem::exists(checkpoint))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        waiting.send_signal(signal);
        const Finished stopped = waiting.finish();
        EXPECT_EQ(stopped.code, signal == SIGINT ? 6 : -1) << stopped.err;
        EXPECT_FALSE(exists("resumed.off"));
        const Finished rest =
            trisect(arguments(path_file, {"-o", resumed, "--resume", checkpoint}));
        EXPECT_EQ(rest.code, 0) << rest.err;
        EXPECT_EQ(read(whole), read(resumed));
        std::filesystem::remove(resumed);
    }
    // What is finished stays so; a checkpoint of something else is none.
    const Finished again = trisect(arguments(path_file, {"--resume", checkpoint, "--json"}));
    EXPECT_EQ(again.json()["removed"], 20 * 20 * 2);
    EXPECT_EQ(mill(slot("8"), {"--resume", checkpoint}).code, 3);
    EXPECT_EQ(mill(slot("8"), {"--resume", stock_}).code, 3);
}

TEST_F(MillCommand, PageTableAndPicture) {
    const json d = document(slot("1"), {"--page", path("page.html"), "--log", path("log.csv"),
                                        "--picture", path("picture.png"), "--frames", "3"});
    EXPECT_EQ(d["page"]["frames"], (json{0, 1, 2}));
    const std::string page = read(path("page.html"));
    EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
    EXPECT_EQ(page.find("http"), std::string::npos);  // loads nothing
    EXPECT_NE(page.find("\"kind\":\"holder through stock\""), std::string::npos);
    const std::string log = read(path("log.csv"));
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1 + 2);
    EXPECT_EQ(trisect::test::decoded_png(read(path("picture.png"))).width, 1200U);
}

TEST_F(MillCommand, OptionsThatMakeNoSense) {
    EXPECT_EQ(mill(slot("8"), {"--page", path("page.png")}).code, 2);
    EXPECT_EQ(mill(slot("8"), {"--chord", "0"}).code, 2);
    EXPECT_EQ(mill(slot("8"), {"--frames", "1"}).code, 2);
    EXPECT_EQ(mill(slot("8"), {"--grid", "3"}).code, 2);
    EXPECT_EQ(mill(slot("8"), {"-o", path("a.off"), "--log", path("a.off")}).code, 2);
    EXPECT_EQ(trisect({"mill", stock_, tool_, holder_}).code, 2);
    EXPECT_EQ(trisect({"mill", "-", tool_, holder_, "--path", "-"}).code, 2);
}

}  // namespace
