// SPDX-License-Identifier: Apache-2.0
//
// The corpus as its users see it; our own results must score in full against counted numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class CorpusCommand : public trisect::test::Scratch {
protected:
    /// Writes the family, computes every case with this program and scores that.
    Finished scored(const std::string& family) {
        const std::string folder = path("corpus");
        const Finished written = trisect({"corpus", folder, "--family", family, "--json"});
        EXPECT_EQ(written.code, 0) << written.err;
        const json document = written.json();
        for (const json& name : document["cases"]) {
            const json scene = json::parse(read(folder + "/" + name.get<std::string>() + ".json"));
            std::vector<std::string> arguments{scene["op"].get<std::string>()};
            for (const json& file : scene["operands"])
                arguments.push_back(folder + "/" + file.get<std::string>());
            arguments.insert(arguments.end(),
                             {"-o", folder + "/" + name.get<std::string>() + ".off", "-q"});
            EXPECT_EQ(trisect(arguments).code, 0) << name;
        }
        return trisect({"corpus", folder, "--results", folder, "--json"});
    }
};

TEST_F(CorpusCommand, BoxesThatTouchInEveryWay) {
    const Finished score = scored("touching");
    EXPECT_EQ(score.code, 0) << score.out;
    EXPECT_EQ(score.json()["counts"]["equal"], 48);
}

TEST_F(CorpusCommand, ScoresThatGoIntoItsFolderAreNoCase) {
    ASSERT_EQ(scored("twins").code, 0);
    const std::string folder = path("corpus");
    const Finished score = trisect({"corpus", folder, "--results", folder, "--json"},
                                   {.output_file = folder + "/scores.json"});
    EXPECT_EQ(score.code, 0) << score.err;
    EXPECT_EQ(score.json()["schema"], "trisect.corpus_score/1");
}

TEST_F(CorpusCommand, BoxesThatDifferByOneUlp) {
    const Finished score = scored("twins");
    EXPECT_EQ(score.code, 0) << score.out;
}

TEST_F(CorpusCommand, SpongesCheckerboardsAndCavities) {
    for (const char* family : {"sponge", "checkerboard", "nested", "thin-walls"})
        EXPECT_EQ(scored(family).code, 0) << family;
}

TEST_F(CorpusCommand, CountedNumbersOfASponge) {
    const std::string folder = path("corpus");
    ASSERT_EQ(trisect({"corpus", folder, "--family", "sponge"}).code, 0);
    // 20 of 27 cubes, 400 of 729; faces 8·6 outside and 6·4 inside for the first level.
    const json one = json::parse(read(folder + "/sponge-1.json"));
    EXPECT_EQ(one["volume"], "20");
    EXPECT_EQ(one["area"], "72");
    EXPECT_EQ(one["euler"], -4);  // genus 5: half of 2 - 10
    EXPECT_EQ(json::parse(read(folder + "/sponge-2.json"))["volume"], "400");
    ASSERT_EQ(trisect({"corpus", folder, "--family", "genus-64"}).code, 0);
    EXPECT_EQ(json::parse(read(folder + "/genus-64.json"))["euler"], -63);
}

// "p" or "p/q".
long double value(const std::string& fraction) {
    const std::size_t slash = fraction.find('/');
    const long double top = std::stold(fraction.substr(0, slash));
    return slash == std::string::npos ? top : top / std::stold(fraction.substr(slash + 1));
}

TEST_F(CorpusCommand, SlantedTerrain) {
    const Finished score = scored("slanted-terrain");
    EXPECT_EQ(score.code, 0) << score.out << score.err;
    EXPECT_EQ(score.json()["counts"]["equal"], 3);
}

// Volume, and area as a sum of square roots, of what the command computes.
TEST_F(CorpusCommand, PolygonsOfManyCorners) {
    const std::string folder = path("corpus");
    const json written = trisect({"corpus", folder, "--family", "polygon-1000", "--json"}).json();
    for (const json& name : written["cases"]) {
        const std::string at = folder + "/" + name.get<std::string>();
        const json expected = json::parse(read(at + ".json"));
        ASSERT_EQ(trisect({expected["op"], at + "-0.off", at + "-1.off", "-o", at + ".off", "-q",
                           "--assume-embedded"})
                      .code,
                  0);
        long double area = value(expected["area"]);
        for (const json& root : expected["area_roots"])
            area += value(root[0]) * std::sqrt(root[1].get<long double>());
        const json info = trisect({"info", at + ".off", "--json", "--exact"}).json();
        EXPECT_EQ(info["volume_exact"], expected["volume"]) << name;
        EXPECT_DOUBLE_EQ(info["area"].get<double>(), static_cast<double>(area)) << name;
    }
}

TEST_F(CorpusCommand, MissingAndWrongResultsAreFindings) {
    const std::string folder = path("corpus");
    ASSERT_EQ(trisect({"corpus", folder, "--family", "terrain"}).code, 0);
    const Finished missing = trisect({"corpus", folder, "--results", path("none"), "--json"});
    EXPECT_EQ(missing.code, 1);
    EXPECT_EQ(missing.json()["counts"]["missing"], 1);
    EXPECT_EQ(trisect({"corpus", folder, "--family", "spheres"}).code, 2);
}

}  // namespace
