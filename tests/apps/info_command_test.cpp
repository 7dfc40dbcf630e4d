// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class InfoCommand : public trisect::test::Scratch {};

TEST_F(InfoCommand, CountsAndMeasuresOfABox) {
    const json info = trisect({"info", box("a.obj", {0, 0, 0}, {2, 3, 4}), "--json"}).json();
    EXPECT_EQ(info["schema"], "trisect.info/1");
    EXPECT_EQ(info["vertices"], 8);
    EXPECT_EQ(info["edges"], 12);
    EXPECT_EQ(info["faces"], 6);
    EXPECT_EQ(info["triangles"], 12);
    EXPECT_EQ(info["shells"], 1);
    EXPECT_EQ(info["genus"], 0);
    EXPECT_EQ(info["closed"], true);
    EXPECT_EQ(info["volume"], 24);
    EXPECT_EQ(info["area"], 52);
    EXPECT_EQ(info["bounds"]["lower"], json::array({0, 0, 0}));
    EXPECT_EQ(info["bounds"]["upper"], json::array({2, 3, 4}));
    EXPECT_EQ(info["lattice"]["lossless"], true);
    EXPECT_EQ(info["lattice"]["moved"], 0);
    EXPECT_EQ(info["lattice"]["max_move"], 0);
    EXPECT_TRUE(info["span_bits"].is_number_integer());
    EXPECT_FALSE(info.contains("volume_exact"));
}

TEST_F(InfoCommand, ExactVolumeIsAFraction) {
    const std::string tetrahedron =
        write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const json info = trisect({"info", tetrahedron, "--exact", "--json"}).json();
    EXPECT_EQ(info["volume_exact"], "1/6");
    EXPECT_EQ(info["volume"], 1.0 / 6.0);
    EXPECT_EQ(info["area"], 2.366025403784439);  // 3/2 + sqrt(3)/2, correctly rounded
}

TEST_F(InfoCommand, OpenBoundaryHasNoVolume) {
    const Finished result = trisect({"info", open_box("open.obj"), "--json"});
    EXPECT_EQ(result.code, 0);
    const json info = result.json();
    EXPECT_EQ(info["closed"], false);
    EXPECT_TRUE(info["volume"].is_null());
    EXPECT_TRUE(info["genus"].is_null());
    EXPECT_EQ(info["vertices"], 8);
    EXPECT_EQ(info["edges"], 12);
    EXPECT_EQ(info["faces"], 5);
    EXPECT_EQ(info["shells"], 1);
    EXPECT_EQ(info["area"], 5);
}

TEST_F(InfoCommand, TwoBoxesAreTwoShells) {
    // They meet along an edge, of which each keeps its own copy.
    const std::string text = trisect::test::box_text({0, 0, 0}, {1, 1, 1}) +
                             trisect::test::box_text({1, 1, 0}, {2, 2, 1}, 9);
    const json info = trisect({"info", write("two.obj", text), "--json"}).json();
    EXPECT_EQ(info["edges"], 24);
    EXPECT_EQ(info["shells"], 2);
    EXPECT_EQ(info["volume"], 2);
    EXPECT_EQ(info["genus"], 0);
}

TEST_F(InfoCommand, RoundingIsReported) {
    const std::string file = box("a.obj", {0, 0, 0}, {1, 1, 300});
    const Finished result = trisect({"info", file, "--lattice", "8", "--json"});
    const json lattice = result.json()["lattice"];
    EXPECT_EQ(lattice["exponent"], 8);
    EXPECT_EQ(lattice["lossless"], false);
    EXPECT_EQ(lattice["moved"], 7);
    EXPECT_EQ(lattice["max_move"], 44);
    EXPECT_NE(result.err.find("rounded"), std::string::npos);
    EXPECT_EQ(trisect({"info", file, "--lattice", "8", "-q"}).err, "");
}

TEST_F(InfoCommand, BoundsAreTheNumbersOfTheFile) {
    const std::string file = write("decimals.off",
                                   "OFF\n4 4 0\n0.1 -0.3 1e-17\n1000.7 -0.3 1e-17\n0.1 0.7 1e-17\n"
                                   "0.1 -0.3 5e-9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    const Finished result = trisect({"info", file});
    EXPECT_NE(result.out.find("bounds     (0.1, -0.3, 1e-17) to (1000.7, 0.7, 5e-09)\n"),
              std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find("lossless"), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "");
}

TEST_F(InfoCommand, HumanTextIsAligned) {
    const Finished result = trisect({"info", box("a.obj", {0, 0, 0}, {1, 1, 1})});
    EXPECT_NE(result.out.find("vertices   8\n"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("volume     1\n"), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "");
}

TEST_F(InfoCommand, LocaleChangesNothing) {
    const std::string file = write("t.obj",
                                   "v 0.5 0 0\nv 1.25 0 0\nv 0.5 1 0\nv 0.5 0 1\n"
                                   "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string expected = trisect({"info", file}, {"", {{"LC_ALL", "C"}}}).out;
    for (const char* locale : {"de_DE.UTF-8", "tr_TR.UTF-8", "de_DE"}) {
        const trisect::test::Surroundings there{"", {{"LC_ALL", locale}, {"LANG", locale}}};
        EXPECT_EQ(trisect({"info", file, "--max-seconds", "60.5"}, there).out, expected);
    }
}

}  // namespace
