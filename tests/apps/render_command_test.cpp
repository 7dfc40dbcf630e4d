// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "picture.h"
#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::decoded_png;
using trisect::test::Finished;
using trisect::test::Pixels;
using trisect::test::trisect;

using Pixel = std::array<std::uint8_t, 4>;

bool is_bluish(const Pixel& p) { return p[2] > p[0] + 20; }
bool is_reddish(const Pixel& p) { return p[0] > p[2] + 20; }

class RenderCommand : public trisect::test::Scratch {
protected:
    /// Draws with more options and decodes the file.
    Pixels drawn(std::vector<std::string> options) {
        options.insert(options.begin(), "render");
        options.insert(options.end(), {"-o", out_, "--background", "white", "--json"});
        const Finished result = trisect(options);
        EXPECT_EQ(result.code, 0) << result.err;
        document_ = result.json();
        return decoded_png(read(out_));
    }
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
    std::string post_ = box("post.obj", {0, 0, 2}, {1, 1, 4});
    std::string out_ = path("out.png");
    json document_;
};

TEST_F(RenderCommand, SquareFaceFillsTheMiddleOfThePicture) {
    const Pixels picture = drawn({cube_, "--view", "front", "--size", "100x60"});
    EXPECT_EQ(picture.width, 100U);
    EXPECT_EQ(picture.height, 60U);
    EXPECT_TRUE(is_bluish(picture.at(50, 30)));
    const Pixel white{255, 255, 255, 255};
    for (const auto& [x, y] : {std::pair{0U, 0U}, {99U, 59U}, {20U, 30U}, {50U, 1U}}) {
        EXPECT_EQ(picture.at(x, y), white) << x << ' ' << y;
    }
    EXPECT_EQ(document_["schema"], "trisect.render/1");
    EXPECT_EQ(document_["size"], json::array({100, 60}));
    // 60 pixels less 6 % on each side, squared.
    EXPECT_NEAR(document_["pixels_hit"].get<double>(), 52.8 * 52.8, 110);
    EXPECT_GE(document_["rays"], 6000);
}

TEST_F(RenderCommand, FaceIsOfOneColourAndItsOutlineDark) {
    const Pixels picture = drawn({cube_, "--view", "front", "--size", "100x100"});
    const Pixel middle = picture.at(50, 50);
    for (std::uint32_t y = 20; y < 80; ++y) {
        for (std::uint32_t x = 20; x < 80; ++x) {
            for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_LE(std::abs(picture.at(x, y)[k] - middle[k]), 6) << x << ' ' << y;
            }
        }
    }
    std::uint8_t darkest = 255;
    for (std::uint32_t x = 3; x < 10; ++x) darkest = std::min(darkest, picture.at(x, 50)[2]);
    EXPECT_LT(darkest + 40, middle[2]);
}

TEST_F(RenderCommand, TrianglesOfOneFaceHaveNoEdgeBetweenThem) {
    // The same cube in twelve triangles gives the same picture, byte for byte.
    const std::string triangles = path("cube.stl");
    ASSERT_EQ(trisect({"convert", cube_, "-o", triangles}).code, 0);
    (void)drawn({cube_, "--edges", "all", "--size", "120x90"});
    const std::string first = read(out_);
    (void)drawn({triangles, "--edges", "all", "--size", "120x90"});
    EXPECT_TRUE(read(out_) == first);
}

TEST_F(RenderCommand, EdgesBetweenFacesAreDrawnUnlessToldOtherwise) {
    // Seen along the diagonal, the vertical edge in front is in the middle of the picture.
    const auto darkest_in_the_middle = [](const Pixels& picture) {
        std::uint8_t darkest = 255;
        for (std::uint32_t x = 45; x < 55; ++x) darkest = std::min(darkest, picture.at(x, 70)[2]);
        return darkest;
    };
    const int with = darkest_in_the_middle(drawn({cube_, "--size", "100x100"}));
    const int without =
        darkest_in_the_middle(drawn({cube_, "--size", "100x100", "--edges", "none"}));
    EXPECT_LT(with + 25, without);
}

TEST_F(RenderCommand, FacesHaveTheColourOfTheirOperand) {
    const Pixels picture =
        drawn({cube_, post_, "--op", "union", "--view", "front", "--size", "100x100"});
    // Four high, two wide: the post stands on the left half.
    EXPECT_TRUE(is_bluish(picture.at(50, 75)));
    EXPECT_TRUE(is_reddish(picture.at(40, 25)));
    EXPECT_EQ(picture.at(65, 25), (Pixel{255, 255, 255, 255}));
    EXPECT_EQ(document_["op"], "union");
    EXPECT_EQ(document_["inputs"].size(), 2U);
}

TEST_F(RenderCommand, DifferenceShowsTheToolsFacesInItsColour) {
    const std::string tool = box("tool.obj", {1, -1, 1}, {3, 1, 3});
    const Pixels picture =
        drawn({cube_, tool, "--op", "difference", "--view", "front", "--size", "100x100"});
    EXPECT_TRUE(is_bluish(picture.at(25, 75)));
    EXPECT_TRUE(is_reddish(picture.at(75, 25)));  // the bottom of the notch, a face of the tool
}

TEST_F(RenderCommand, SectionIsHatchedAndOpensTheSolid) {
    const Pixels whole = drawn({cube_, "--view", "top", "--size", "100x100"});
    EXPECT_TRUE(is_bluish(whole.at(50, 50)));
    const Pixels cut = drawn({cube_, "--view", "top", "--size", "100x100", "--section", "z"});
    std::size_t section = 0;
    for (std::uint32_t x = 20; x < 80; ++x) section += is_reddish(cut.at(x, 50)) ? 1U : 0U;
    EXPECT_EQ(section, 60U);
    // Hatched: not all alike.
    const auto row = [&](std::uint32_t x) { return cut.at(x, 50); };
    bool differs = false;
    for (std::uint32_t x = 21; x < 80; ++x) differs |= row(x) != row(20);
    EXPECT_TRUE(differs);
    // Half of it is gone.
    const Pixels front =
        drawn({cube_, "--view", "front", "--size", "100x100", "--section", "0,0,1,-1"});
    EXPECT_NEAR(document_["pixels_hit"].get<double>(), 88 * 44, 150);
    EXPECT_TRUE(is_bluish(front.at(50, 50)));
}

TEST_F(RenderCommand, HollowIsSeenInTheSection) {
    const std::string cavity = box("cavity.obj", {0, 0, 0}, {1, 1, 1});
    const std::string shell = box("shell.obj", {-1, -1, -1}, {2, 2, 2});
    const Pixels cut = drawn({shell, cavity, "--op", "difference", "--section", "z", "--view",
                              "top", "--size", "100x100"});
    // The floor of the cavity: the tool's colour, and not hatched.
    const Pixel floor = cut.at(50, 50);
    EXPECT_TRUE(is_reddish(floor));
    for (std::uint32_t x = 42; x < 58; ++x) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(std::abs(cut.at(x, 50)[k] - floor[k]), 8);
    }
}

TEST_F(RenderCommand, AnyDirectionAndPerspectiveFitThePicture) {
    for (const char* view : {"iso", "back", "bottom", "-1,2,.5", "0,0,-3"}) {
        for (const char* opening : {"0", "30", "90"}) {
            const Pixels picture =
                drawn({cube_, "--view", view, "--perspective", opening, "--size", "80x60"});
            const Pixel white{255, 255, 255, 255};
            for (std::uint32_t x = 0; x < 80; ++x) {
                EXPECT_EQ(picture.at(x, 0), white) << view << ' ' << opening;
                EXPECT_EQ(picture.at(x, 59), white) << view << ' ' << opening;
            }
            for (std::uint32_t y = 0; y < 60; ++y) {
                EXPECT_EQ(picture.at(0, y), white) << view << ' ' << opening;
                EXPECT_EQ(picture.at(79, y), white) << view << ' ' << opening;
            }
            EXPECT_GT(document_["pixels_hit"], 500) << view << ' ' << opening;
        }
    }
}

TEST_F(RenderCommand, UpAxisTurnsTheModel) {
    const std::string slab = box("slab.obj", {0, 0, 0}, {4, 1, 2});
    const auto width_and_height = [&](const char* up) {
        const Pixels picture =
            drawn({slab, "--view", "front", "--up", up, "--size", "100x100", "--edges", "none"});
        std::uint32_t wide = 0;
        std::uint32_t high = 0;
        for (std::uint32_t i = 0; i < 100; ++i) {
            wide += picture.at(i, 50)[0] < 250 ? 1 : 0;
            high += picture.at(50, i)[0] < 250 ? 1 : 0;
        }
        return std::pair{wide, high};
    };
    EXPECT_NEAR(width_and_height("z").first, 88, 2);
    EXPECT_NEAR(width_and_height("z").second, 44, 2);
    EXPECT_NEAR(width_and_height("y").second, 22, 2);
    EXPECT_NEAR(width_and_height("x").second, 88, 2);
    EXPECT_NEAR(width_and_height("x").first, 44, 2);
}

TEST_F(RenderCommand, TransparentBackgroundHasAlpha) {
    const Finished result = trisect({"render", cube_, "-o", out_, "--view", "front", "--size",
                                     "50x50", "--background", "transparent"});
    ASSERT_EQ(result.code, 0) << result.err;
    const Pixels picture = decoded_png(read(out_));
    EXPECT_EQ(picture.at(0, 0)[3], 0);
    EXPECT_EQ(picture.at(25, 25)[3], 255);
}

TEST_F(RenderCommand, SamePictureWithAnyNumberOfThreads) {
    const std::string tool = box("tool.obj", {1, -1, 1}, {3, 1, 3});
    std::vector<std::string> pictures;
    for (const char* threads : {"1", "2", "7"}) {
        ASSERT_EQ(trisect({"render", cube_, tool, "--op", "difference", "-o", out_, "--threads",
                           threads, "--size", "160x120"})
                      .code,
                  0);
        pictures.push_back(read(out_));
    }
    EXPECT_TRUE(pictures[0] == pictures[1]);
    EXPECT_TRUE(pictures[0] == pictures[2]);
}

TEST_F(RenderCommand, EmptySetIsAnEmptyPicture) {
    const Pixels picture = drawn({cube_, cube_, "--op", "difference", "--size", "20x20"});
    EXPECT_EQ(document_["pixels_hit"], 0);
    for (const Pixel& pixel : picture.values) EXPECT_EQ(pixel, (Pixel{255, 255, 255, 255}));
}

TEST_F(RenderCommand, StandardOutputIsAPngFile) {
    const Finished result = trisect({"render", cube_, "-o", "-", "--size", "30x20"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(decoded_png(result.out).width, 30U);
}

TEST_F(RenderCommand, MistakesAreUsageErrors) {
    const std::vector<std::vector<std::string>> mistakes{
        {},
        {"-o", path("out.jpg")},
        {"-o", "-", "--json"},
        {"-o", out_, "--size", "100"},
        {"-o", out_, "--size", "0x100"},
        {"-o", out_, "--size", "100x100x3"},
        {"-o", out_, "--size", "99999x99999"},
        {"-o", out_, "--size", "16384x16384"},
        {"-o", out_, "--view", "above"},
        {"-o", out_, "--view", "0,0,0"},
        {"-o", out_, "--view", "1,2"},
        {"-o", out_, "--section", "w"},
        {"-o", out_, "--section", "z=high"},
        {"-o", out_, "--section", "0,0,0,1"},
        {"-o", out_, "--section", "1,2,3"},
        {"-o", out_, "--perspective", "180"},
        {"-o", out_, "--samples", "0"},
        {"-o", out_, "--up", "w"},
        {"-o", out_, "--op", "minus"},
        {"-o", out_, "--background", "green"},
    };
    for (auto arguments : mistakes) {
        arguments.insert(arguments.begin(), {"render", cube_});
        const Finished result = trisect(arguments);
        EXPECT_EQ(result.code, 2) << testing::PrintToString(arguments) << result.err;
    }
    EXPECT_FALSE(exists("out.png"));
}

TEST_F(RenderCommand, OpenMeshIsNoSolid) {
    EXPECT_EQ(trisect({"render", open_box("open.obj"), "-o", out_}).code, 4);
    EXPECT_FALSE(exists("out.png"));
}

}  // namespace
