// SPDX-License-Identifier: Apache-2.0
//
// Standard input and output, pipes that close, and what goes where.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::test::box_text;
using trisect::test::Finished;
using trisect::test::trisect;

class Streams : public trisect::test::Scratch {
protected:
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
};

TEST_F(Streams, StandardInputIsRecognisedByItsContent) {
    const Finished result = trisect({"info", "-", "--json"}, {box_text({0, 0, 0}, {1, 1, 2}), {}});
    EXPECT_EQ(result.json()["volume"], 2);
}

TEST_F(Streams, BinaryPassesThroughBothStreams) {
    for (const char* format : {"stl", "ply", "off", "obj", "stl-ascii"}) {
        const Finished first = trisect({"convert", cube_, "-o", "-", "--format", format});
        ASSERT_EQ(first.code, 0) << first.err;
        const Finished second =
            trisect({"info", "-", "--format", format, "--json"}, {first.out, {}});
        EXPECT_EQ(second.json()["volume"], 8) << format;
    }
}

TEST_F(Streams, BooleanInAPipeline) {
    const Finished result = trisect({"difference", cube_, "-", "-o", "-", "--format", "obj"},
                                    {box_text({1, 1, 1}, {3, 3, 3}), {}});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.err.find("volume 7"), std::string::npos) << result.err;
    EXPECT_EQ(trisect({"info", "-", "--json"}, {result.out, {}}).json()["volume"], 7);
}

TEST_F(Streams, EmptyStandardInputIsAnError) {
    EXPECT_EQ(trisect({"info", "-"}).code, 3);
    EXPECT_EQ(trisect({"info", "-", "--format", "stl"}).code, 3);
}

TEST_F(Streams, ClosedPipeIsAnErrorAndNoSignal) {
    for (const std::string option : {"--json", "-v"}) {
        const Finished result = trisect::test::trisect_into_closed_pipe({"info", cube_, option});
        EXPECT_EQ(result.signal, 0);
        EXPECT_EQ(result.code, 3);
        EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
    }
    const Finished result =
        trisect::test::trisect_into_closed_pipe({"convert", cube_, "-o", "-", "--format", "stl"});
    EXPECT_EQ(result.code, 3);
}

TEST_F(Streams, QuietLeavesOnlyErrors) {
    const std::string out = path("o.obj");
    EXPECT_EQ(trisect({"union", cube_, cube_, "-o", out, "-q"}).err, "");
    EXPECT_NE(trisect({"info", path("missing.obj"), "-q"}).err, "");
}

TEST_F(Streams, NoProgressWithoutATerminal) {
    const Finished result = trisect({"info", cube_, "--progress", "bar"});
    EXPECT_EQ(result.err, "");
}

TEST_F(Streams, OptionsMayStandBeforeTheCommand) {
    EXPECT_EQ(trisect({"--json", "info", cube_}).json()["volume"], 8);
}

TEST_F(Streams, FailedRunKeepsTheOldFile) {
    const std::string out = write("o.obj", "the old one");
    EXPECT_EQ(trisect({"union", cube_, open_box("open.obj"), "-o", out}).code, 4);
    EXPECT_EQ(read(out), "the old one");
    EXPECT_EQ(entry_count(), 3U);
}

TEST_F(Streams, LinksToOutputsThatAreNotThereAreFollowed) {
    namespace fs = std::filesystem;
    fs::create_symlink("new.off", path("link.off"));
    EXPECT_EQ(trisect({"convert", cube_, "-o", path("link.off")}).code, 0);
    EXPECT_TRUE(fs::is_symlink(path("link.off")));
    EXPECT_EQ(trisect({"check", path("new.off")}).code, 0);
    fs::create_symlink("none/new.off", path("astray.off"));
    EXPECT_EQ(trisect({"convert", cube_, "-o", path("astray.off")}).code, 3);
    EXPECT_TRUE(fs::is_symlink(path("astray.off")));
    EXPECT_EQ(entry_count(), 4U);
}

}  // namespace
