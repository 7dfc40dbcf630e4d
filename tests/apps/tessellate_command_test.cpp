// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/brep/io/read_patches.h>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class TessellateCommand : public trisect::test::Scratch {
protected:
    std::string sphere_ =
        write("sphere.bpt", patches_text(::trisect::make_curved_sphere(2).patches()));
    std::string out_ = path("sphere.off");
};

TEST_F(TessellateCommand, MeshStaysWithinTheDeviation) {
    const Finished done =
        trisect({"tessellate", sphere_, "-o", out_, "--deviation", "0.01", "--json"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(done.json()["schema"], "trisect.tessellate/1");
    EXPECT_EQ(done.json()["patches"], 8);
    EXPECT_LE(done.json()["deviation"], 0.01);
    const json info = trisect({"info", out_, "--json"}).json();
    EXPECT_EQ(info["closed"], true);
    EXPECT_NEAR(info["volume"].get<double>(), 33.510, 0.01 * 50.3);
}

TEST_F(TessellateCommand, PatchesThatDoNotCloseAreNamed) {
    auto patches = ::trisect::read_patches(read(sphere_), "sphere");
    patches.pop_back();
    const std::string open = write("open.bpt", patches_text(patches));
    const Finished done = trisect({"tessellate", open, "-o", out_, "--deviation", "0.1"});
    EXPECT_EQ(done.code, 3);
    EXPECT_NE(done.err.find("the patches do not close: side "), std::string::npos) << done.err;
    EXPECT_FALSE(exists("sphere.off"));
    const Finished broken =
        trisect({"tessellate", write("x.bpt", "1\n1 1\n0 0\n"), "-o", out_, "--deviation", "0.1"});
    EXPECT_EQ(broken.code, 3);
    EXPECT_NE(broken.err.find("x.bpt:3:"), std::string::npos) << broken.err;
    EXPECT_EQ(trisect({"tessellate", sphere_, "-o", out_, "--deviation", "0"}).code, 2);
}

}  // namespace
