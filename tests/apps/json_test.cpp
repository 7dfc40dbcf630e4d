// SPDX-License-Identifier: Apache-2.0
//
// With --json the standard output is exactly one document with a schema, whatever happens.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::test::Finished;
using trisect::test::trisect;

class Json : public trisect::test::Scratch {};

TEST_F(Json, EveryErrorIsADocument) {
    const std::string cube = box("cube.obj", {0, 0, 0}, {1, 1, 1});
    const std::string open = open_box("open.obj");
    const std::vector<std::vector<std::string>> failures{
        {"--json"},
        {"--json", "info"},
        {"nonsense", "--json"},
        {"info", cube, "--json", "--nonsense"},
        {"info", path("missing.obj"), "--json"},
        {"union", cube, open, "-o", path("o.obj"), "--json"},
        {"union", cube, cube, "-o", path("o.what"), "--json"},
        {"union", cube, cube, "-o", path("no/folder.obj"), "--json"},
    };
    for (const auto& arguments : failures) {
        const Finished result = trisect(arguments);
        const auto document = result.json();
        EXPECT_EQ(document["schema"], "trisect.error/1") << result.out;
        for (const char* key : {"code", "message", "file", "line", "column"}) {
            EXPECT_TRUE(document["error"].contains(key)) << key;
        }
        EXPECT_EQ(document["error"]["code"], result.code);
        EXPECT_GE(result.code, 2);
    }
}

TEST_F(Json, DefectsOfAnOperandAreInTheError) {
    const auto document = trisect({"union", open_box("open.obj"), open_box("open.obj"), "-o",
                                   path("o.obj"), "--json"})
                              .json();
    EXPECT_EQ(document["error"]["file"], path("open.obj"));
    EXPECT_EQ(document["error"]["kind"], "invalid_solid");
    EXPECT_FALSE(document["error"]["defects"].empty());
}

TEST_F(Json, NamesThatAreNotUtf8StillMakeADocument) {
    const Finished result = trisect({"info", path("\xff\xfe.obj"), "--json"});
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.json()["schema"], "trisect.error/1");
}

TEST_F(Json, HelpAndVersionAreDocumentsToo) {
    EXPECT_EQ(trisect({"--help", "--json"}).json()["schema"], "trisect.help/1");
    EXPECT_EQ(trisect({"--version", "--json"}).json()["schema"], "trisect.version/1");
}

TEST_F(Json, AFileMayBeCalledJson) {
    const Finished result = trisect({"info", "--", "--json"});
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.out, "");
}

}  // namespace
