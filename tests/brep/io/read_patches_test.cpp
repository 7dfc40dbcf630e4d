// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/io/read_patches.h>

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/kernel/error.h>

#include "support/random_patch.h"

namespace read_patches_test {
namespace {

using trisect::BezierPatch;
using trisect::read_patches;

TEST(ReadPatches, ReadsBackWhatWasWritten) {
    std::mt19937_64 random(8);
    std::vector<BezierPatch> patches;
    for (int k = 0; k < 30; ++k) patches.push_back(trisect::test::random_patch(random, k % 2 == 0));
    EXPECT_EQ(read_patches(patches_text(patches), "text"), patches);
    const auto torus = trisect::make_curved_torus(3, 1);
    const std::vector<BezierPatch> sixteen(torus.patches().begin(), torus.patches().end());
    EXPECT_EQ(read_patches(patches_text(sixteen), "text"), sixteen);
}

void expect_error(const std::string& text, const std::string& message) {
    try {
        (void)read_patches(text, "p");
        ADD_FAILURE() << "read: " << text;
    } catch (const trisect::InputError& e) {
        EXPECT_EQ(e.what(), message);
    }
}

TEST(ReadPatches, ErrorsNameTheirPlace) {
    const std::string good = "1 # one patch\n1 1\n0 0 0\n0 1 0\n\n1 0 0\n1 1 0.5\n";
    EXPECT_EQ(read_patches(good, "p").size(), 1U);
    expect_error("", "p:1:1: the file ends before the number of patches");
    expect_error("2\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n",
                 "p:7:1: the file ends before patch 2 of 2");
    expect_error("1\n0 1\n", "p:2:1: '0', read as the degree in u, is not from 1 to 24");
    expect_error("1\n1 25\n", "p:2:3: '25', read as the degree in v, is not from 1 to 24");
    expect_error("1\n1 1\n0 0 0\n0 1 x\n",
                 "p:4:5: 'x', read as the z coordinate of a control point, is not a number");
    expect_error("1\n1 1\n0 0 0\n0 1 0\n",
                 "p:5:1: the file ends before control point 3 of 4 of a patch");
    expect_error("1\n1 1\n0 0 0 1\n0 1 0 2\n1 0 0\n1 1 0 1\n",
                 "p:5:1: a control point without a weight in a rational patch");
    expect_error("1\n1 1\n0 0 0\n0 1 0 2\n",
                 "p:4:1: a control point with a weight in a patch whose first ones have none");
    expect_error("1\n1 1\n0 0 0 1\n0 1 0 -2\n1 0 0 1\n1 1 0 1\n",
                 "p:2:1: the weight of control point 1 is not a positive number between 2^-300 and "
                 "2^300");
    expect_error(good + "7\n",
                 "p:8:1: '7' after the last of the 1 patches that the first line "
                 "states");
}

TEST(ReadPatches, LimitsAreKept) {
    trisect::ReadLimits limits;
    limits.faces = 1;
    EXPECT_THROW((void)read_patches("2\n", "p", limits), trisect::LimitError);
    limits.vertices = 3;
    EXPECT_THROW((void)read_patches("1\n1 1\n0 0 0\n", "p", limits), trisect::LimitError);
}

}  // namespace
}  // namespace read_patches_test
