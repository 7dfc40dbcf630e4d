// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class ClashCommand : public trisect::test::Scratch {
protected:
    ClashCommand() {
        (void)box("cube.obj", {0, 0, 0}, {2, 2, 2});
        (void)box("bar.obj", {0, 0, 0}, {9, 1, 1});
    }

    /// One cube at 0, further parts by file and place.
    [[nodiscard]] static json part(const std::string& name, const std::string& file,
                                   std::vector<double> place, const std::string& group) {
        return {{"name", name}, {"file", file}, {"pose", std::move(place)}, {"group", group}};
    }
    [[nodiscard]] static json plant() {
        json out;
        out["parts"] = {part("base", "cube.obj", {0, 0, 0}, "steel"),
                        part("deep", "cube.obj", {1, 1, 1}, "pipes"),
                        part("flush", "cube.obj", {-2, 0, 0}, "pipes"),
                        part("near", "cube.obj", {0, -3, 0}, "pipes"),
                        part("far", "cube.obj", {90, 0, 0}, "pipes"),
                        part("bar", "bar.obj", {-20, 0, 0}, "steel")};
        return out;
    }
    [[nodiscard]] static json set_of(const std::string& mode) {
        json out{{"name", mode}, {"a", "steel"}, {"b", "pipes"}, {"mode", mode}};
        if (mode == "clearance") out["clearance"] = 1.5;
        return out;
    }
    [[nodiscard]] Finished run(const json& manifest, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"clash", write("plant.json", manifest.dump()), "-o",
                                           path("report.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return trisect(arguments);
    }
    [[nodiscard]] json report() const { return json::parse(read(path("report.json"))); }
    [[nodiscard]] std::set<std::string> found() const {
        std::set<std::string> out;
        const json document = report();
        for (const json& clash : document["clashes"])
            out.insert(clash["a"].get<std::string>() + "-" + clash["b"].get<std::string>() + " " +
                       clash["relation"].get<std::string>());
        return out;
    }
};

TEST_F(ClashCommand, ModesOfSets) {
    json manifest = plant();
    manifest["sets"] = {set_of("intersection")};
    EXPECT_EQ(run(manifest).code, 1);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping"}));
    manifest["sets"] = {set_of("collision")};
    EXPECT_EQ(run(manifest).code, 1);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping", "base-flush touching"}));
    manifest["sets"] = {set_of("clearance")};
    EXPECT_EQ(run(manifest).code, 1);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping", "base-flush touching",
                                              "base-near disjoint"}));
    manifest["sets"][0]["clearance"] = 1;  // just as far away is not nearer
    EXPECT_EQ(run(manifest).code, 1);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping", "base-flush touching"}));
    EXPECT_FALSE(exists("report.json.journal"));
}

TEST_F(ClashCommand, WithoutSetsEverythingIsCompared) {
    EXPECT_EQ(run(plant()).code, 1);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping"}));
    json apart;
    apart["parts"] = {part("a", "cube.obj", {0, 0, 0}, ""), part("b", "cube.obj", {2, 0, 0}, "")};
    EXPECT_EQ(run(apart).code, 0);
}

TEST_F(ClashCommand, VolumesRegionsAndDistances) {
    json manifest = plant();
    manifest["sets"] = {set_of("clearance")};
    EXPECT_EQ(run(manifest, {"--volumes", "--regions"}).code, 1);
    const json document = report();
    for (const json& clash : document["clashes"]) {
        if (clash["b"] == "deep") {
            EXPECT_EQ(clash["volume"]["exact"], "1");
        }
        if (clash["b"] == "flush") {
            EXPECT_EQ(clash["regions"][0]["dimension"], 2);
        }
        if (clash["b"] == "near") {
            EXPECT_LE(clash["distance"]["lower"], 1.0);
            EXPECT_GE(clash["distance"]["upper"], 1.0);
        }
    }
}

TEST_F(ClashCommand, TablesOfParts) {
    const std::string table =
        write("plant.csv", "file,name,pose\ncube.obj,one,\ncube.obj,\"two, turned\",1 0 0\n");
    EXPECT_EQ(trisect({"clash", table, "-o", path("report.csv")}).code, 1);
    const std::string text = read(path("report.csv"));
    EXPECT_NE(text.find("one,\"two, turned\",one,\"two, turned\",,,overlapping,"),
              std::string::npos)
        << text;
}

TEST_F(ClashCommand, ShardsAreTheWhole) {
    EXPECT_EQ(run(plant(), {"--shard", "1/2"}).code, 1);
    EXPECT_EQ(found().size(), 1U);
    EXPECT_EQ(run(plant(), {"--shard", "2/2"}).code, 0);
    EXPECT_EQ(run(plant(), {"--shard", "3/2"}).code, 2);
}

TEST_F(ClashCommand, MissingAndBrokenFiles) {
    json manifest = plant();
    manifest["parts"].push_back(part("lost", "lost.obj", {0, 0, 0}, "pipes"));
    manifest["parts"].push_back(part("open", "open.obj", {0, 0, 0}, "pipes"));
    (void)open_box("open.obj");
    EXPECT_EQ(run(manifest).code, 3);
    EXPECT_EQ(run(manifest, {"--keep-going"}).code, 1);
    EXPECT_EQ(report()["missing"].size(), 2U);
    EXPECT_EQ(report()["missing"][0]["parts"][0], "lost");
    EXPECT_EQ(report()["is_complete"], false);
    EXPECT_EQ(found(), (std::set<std::string>{"base-deep overlapping"}));
}

TEST_F(ClashCommand, ResumesAfterAStop) {
    ASSERT_EQ(run(plant()).code, 1);
    const std::string whole = read(path("report.json"));
    ASSERT_EQ(run(plant(), {"--resume"}).code, 1);
    EXPECT_EQ(read(path("report.json")), whole);
    (void)write("report.json.journal", "{\"schema\":\"trisect.clash-journal/1\",\"key\":\"x\"}\n");
    EXPECT_EQ(run(plant(), {"--resume"}).code, 2);
    EXPECT_EQ(run(plant()).code, 1);
    EXPECT_EQ(read(path("report.json")), whole);
}

TEST_F(ClashCommand, BcfIsAZipFile) {
    EXPECT_EQ(run(plant(), {"-o", path("report.bcf"), "--pictures", path("pictures")}).code, 1);
    const std::string bytes = read(path("report.bcf"));
    EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
    EXPECT_NE(bytes.find("<Title>base and deep: overlapping</Title>"), std::string::npos);
    EXPECT_NE(bytes.find("snapshot.png"), std::string::npos);
    EXPECT_TRUE(exists("pictures/" + report()["clashes"][0]["id"].get<std::string>() + ".png"));
}

TEST_F(ClashCommand, MistakesInManifests) {
    EXPECT_EQ(trisect({"clash", write("m.json", "{"), "-o", path("r.json")}).code, 3);
    EXPECT_EQ(trisect({"clash", write("m.json", "{}"), "-o", path("r.json")}).code, 3);
    json manifest = plant();
    manifest["parts"].push_back(manifest["parts"][0]);
    EXPECT_EQ(run(manifest).code, 3);  // two parts of one name
    // What is misspelt is not left out.
    manifest = plant();
    manifest["parts"][0]["position"] = {1, 2, 3};
    EXPECT_EQ(run(manifest).code, 3);
    EXPECT_NE(run(manifest).err.find("part 0: 'position' is not known"), std::string::npos);
    manifest = plant();
    manifest["clash_sets"] = json::array();
    EXPECT_NE(run(manifest).err.find("the manifest: 'clash_sets' is not known"), std::string::npos);
    manifest = plant();
    manifest["sets"] = {{{"name", "s"}, {"between", "steel"}}};
    EXPECT_NE(run(manifest).err.find("set 's': 'between' is not known"), std::string::npos);
    manifest["sets"] = {{{"name", "s"}}};
    EXPECT_NE(run(manifest).err.find("set 's': 'a' is missing"), std::string::npos);
    manifest = plant();
    manifest["parts"][0].erase("file");
    EXPECT_NE(run(manifest).err.find("part 0 has no file"), std::string::npos);
    manifest = plant();
    manifest["sets"] = {{{"a", "nobody"}}};
    EXPECT_EQ(run(manifest).code, 3);
    manifest = plant();
    manifest["parts"][0]["pose"] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(run(manifest).code, 3);
    EXPECT_EQ(trisect({"clash", write("m.json", plant().dump()), "-o", path("r.txt")}).code, 2);
}

TEST_F(ClashCommand, PageHasClashesAndTheOtherParts) {
    json manifest = plant();
    manifest["sets"] = json::array({set_of("intersection")});
    const std::string page = path("page.html");
    EXPECT_EQ(run(manifest, {"--page", page, "--regions"}).code, 1);
    const std::string text = read(page);
    EXPECT_NE(text.find(R"("shapes":2)"), std::string::npos) << text.substr(0, 6000);
    EXPECT_NE(text.find("1 clashes of 6 parts"), std::string::npos);
    for (const char* name : {"base", "deep", "flush", "near", "far", "bar"})
        EXPECT_NE(text.find(std::string(R"({"name":")") + name + '"'), std::string::npos) << name;
    EXPECT_EQ(run(manifest, {"--page", "-"}).code, 2);
}

TEST_F(ClashCommand, PageOfMergedReportsIsThatOfTheWhole) {
    json manifest = plant();
    manifest["sets"] = json::array({set_of("clearance")});
    EXPECT_EQ(run(manifest, {"--page", path("whole.html")}).code, 1);
    const std::string file = path("plant.json");
    std::vector<std::string> merge{
        "clash", file, "-o", path("merged.json"), "--page", path("merged.html")};
    for (const std::string shard : {"1", "2"}) {
        const std::string report = path("shard" + shard + ".json");
        EXPECT_LE(trisect({"clash", file, "-o", report, "--shard", shard + "/2"}).code, 1);
        merge.insert(merge.end(), {"--merge", report});
    }
    EXPECT_EQ(trisect(merge).code, 1);
    EXPECT_EQ(read(path("merged.html")), read(path("whole.html")));
    std::filesystem::remove(path("bar.obj"));
    EXPECT_EQ(trisect(merge).code, 3);
}

}  // namespace
