// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/csg/drawing/read_dxf.h>
#include <trisect/bsp/modelling/slices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"
#include "xml.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::is_well_formed_xml;
using trisect::test::trisect;
using Loops = std::vector<::trisect::Outline>;

/// Each from its smallest corner on, in order.
Loops in_order(Loops loops) {
    for (auto& loop : loops) {
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

Loops loops_of(const ::trisect::Slice& slice) {
    Loops out;
    for (const auto& loop : slice.loops) {
        auto& places = out.emplace_back();
        for (const std::uint32_t v : loop) places.push_back(slice.points[v]);
    }
    return in_order(out);
}

class SliceCommand : public trisect::test::Scratch {
protected:
    Finished slice(std::vector<std::string> options) {
        options.insert(options.begin(), "slice");
        return trisect(options);
    }
    json report(std::vector<std::string> options) {
        options.emplace_back("--json");
        const Finished result = slice(options);
        EXPECT_EQ(result.code, 0) << result.err;
        return result.json();
    }
    std::vector<double> heights(std::vector<std::string> options) {
        options.insert(options.begin(), cube_);
        std::vector<double> out;
        const json document = report(options);
        for (const json& layer : document["layers"]) out.push_back(layer["height"]);
        return out;
    }
    /// The bytes of an output of the shell.
    std::string written(const std::string& name, std::vector<std::string> options = {}) {
        std::vector<std::string> all{shell_, hole_, "--op", "difference", "-o", path(name)};
        all.insert(all.end(), options.begin(), options.end());
        const Finished result = slice(all);
        EXPECT_EQ(result.code, 0) << result.err;
        return read(path(name));
    }
    std::string cube_ = box("cube.obj", {0, 0, 0}, {2, 2, 2});
    std::string hole_ = box("hole.obj", {0, 0, 0}, {1, 1, 1});
    std::string shell_ = box("shell.obj", {-1, -1, -1}, {2, 2, 2});
};

TEST_F(SliceCommand, PlanesAreInTheMiddleOfSteps) {
    EXPECT_EQ(heights({"--step", "0.5"}), (std::vector<double>{0.25, 0.75, 1.25, 1.75}));
    EXPECT_EQ(heights({"--count", "2"}), (std::vector<double>{0.5, 1.5}));
    // A rest counts where its middle is below the upper end.
    EXPECT_EQ(heights({"--step", "0.75"}), (std::vector<double>{0.375, 1.125, 1.875}));
    EXPECT_EQ(heights({"--step", "1.5"}), (std::vector<double>{0.75}));
    EXPECT_EQ(heights({"--step", "9"}), (std::vector<double>{}));
    EXPECT_EQ(heights({"--step", "1", "--from", "-1", "--to", "1"}),
              (std::vector<double>{-0.5, 0.5}));
    EXPECT_EQ(heights({"--count", "2", "--at", "bottom"}), (std::vector<double>{0, 1}));
    EXPECT_EQ(heights({"--count", "2", "--at", "top"}), (std::vector<double>{1, 2}));
}

TEST_F(SliceCommand, PlanesOfAListGoAsTheyAre) {
    EXPECT_EQ(heights({"--heights", "1.5,-1,0.1"}), (std::vector<double>{1.5, -1, 0.1}));
    EXPECT_EQ(heights({"--heights", "-0.5"}), (std::vector<double>{-0.5}));
    const std::string file = write("h.txt", "# planes\n0.5 1\n\n1.25,1.5\n");
    EXPECT_EQ(heights({"--heights", file}), (std::vector<double>{0.5, 1, 1.25, 1.5}));
}

TEST_F(SliceCommand, ReportHasLayers) {
    const json document =
        report({shell_, hole_, "--op", "difference", "--heights", "-0.5,0.5,2,3"});
    EXPECT_EQ(document["schema"], "trisect.slice/1");
    EXPECT_EQ(document["axis"], "z");
    EXPECT_EQ(document["loops"], 4);
    const json& layers = document["layers"];
    ASSERT_EQ(layers.size(), 4U);
    EXPECT_EQ(layers[0]["area"], 9);
    EXPECT_EQ(layers[1]["area"], 8);
    EXPECT_EQ(layers[1]["perimeter"], 16);
    EXPECT_EQ(layers[1]["loops"], 2);
    EXPECT_EQ(layers[1]["regions"], 1);
    EXPECT_EQ(layers[1]["exact"], true);
    EXPECT_EQ(layers[2]["area"], 9);  // the top itself
    EXPECT_EQ(layers[3]["loops"], 0);
    EXPECT_TRUE(document["volume"].is_null());
    EXPECT_TRUE(document["seconds"].contains("slice"));
    EXPECT_EQ(report({cube_, "--count", "7"})["volume"].get<double>(), 8);
}

TEST_F(SliceCommand, FacesInPlanes) {
    const auto areas = [&](const char* rule) {
        std::vector<double> out;
        const json document = report({cube_, "--heights", "0,2", "--faces", rule});
        for (const json& layer : document["layers"]) out.push_back(layer["area"]);
        return out;
    };
    EXPECT_EQ(areas("closed"), (std::vector<double>{4, 4}));
    EXPECT_EQ(areas("below"), (std::vector<double>{0, 4}));
    EXPECT_EQ(areas("above"), (std::vector<double>{4, 0}));
}

TEST_F(SliceCommand, AcrossAllAxes) {
    const std::string bar = box("bar.obj", {0, 10, 200}, {1, 12, 203});
    for (const auto& [axis, height, corner] : {std::tuple{"x", 0.5, json{12, 203}},
                                               {"y", 11.0, json{1, 203}},
                                               {"z", 201.5, json{1, 12}}}) {
        const std::string file = path("o.json");
        const json document = report({bar, "--count", "1", "--axis", axis, "-o", file});
        EXPECT_EQ(document["layers"][0]["height"], height);
        const json layers = json::parse(read(file));
        EXPECT_EQ(layers["axis"], axis);
        const json& outer = layers["layers"][0]["regions"][0]["outer"];
        EXPECT_NE(std::find(outer.begin(), outer.end(), corner), outer.end()) << outer;
    }
    for (const auto& [rule, area] : {std::pair{"below", 3.0}, {"above", 0.0}})
        EXPECT_EQ(
            report({bar, "--heights", "12", "--axis", "y", "--faces", rule})["layers"][0]["area"],
            area);
}

TEST_F(SliceCommand, DrawingHasAGroupForEachLayer) {
    const std::string svg = written("o.svg", {"--heights", "-0.5,0.125"});
    EXPECT_TRUE(is_well_formed_xml(svg)) << svg;
    EXPECT_NE(svg.find("<g id=\"layer0\" slic3r:z=\"-0.5\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("<g id=\"layer1\" slic3r:z=\"0.125\""), std::string::npos);
    EXPECT_NE(svg.find("<polygon slic3r:type=\"contour\" points=\"2,-1 2,2 -1,2 -1,-1\""),
              std::string::npos)
        << svg;
    EXPECT_NE(svg.find("<polygon slic3r:type=\"hole\""), std::string::npos);
    EXPECT_TRUE(is_well_formed_xml(written("e.svg", {"--heights", "99"})));
}

TEST_F(SliceCommand, LayersOfTheCommonInterface) {
    const std::string cli = written("o.cli", {"--count", "3"});
    EXPECT_TRUE(cli.starts_with("$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n")) << cli;
    EXPECT_NE(cli.find("$$LAYERS/4\n$$DIMENSION/-1,-1,-1,2,2,2\n$$HEADEREND\n"), std::string::npos);
    // The upper sides, and the lower side of the first one.
    EXPECT_NE(cli.find("$$GEOMETRYSTART\n$$LAYER/-1\n$$LAYER/0\n$$POLYLINE/1,1,5,"),
              std::string::npos);
    EXPECT_NE(cli.find("$$LAYER/1\n"), std::string::npos);
    EXPECT_NE(cli.find("\n$$POLYLINE/1,0,5,"), std::string::npos);
    EXPECT_TRUE(cli.ends_with("$$GEOMETRYEND\n"));
    std::istringstream lines(cli);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("$$POLYLINE/")) continue;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
    }
    EXPECT_EQ(slice({cube_, "--heights", "1,0.5", "-o", path("x.cli")}).code, 7);
    EXPECT_FALSE(exists("x.cli"));
}

// Of a ball the corners are no doubles, and far enough apart for the reader's grid.
TEST_F(SliceCommand, DxfIsReadBack) {
    const ::trisect::PolygonMesh ball = ::trisect::make_icosphere(10, 2);
    const std::string file = path("ball.off");
    ::trisect::write_mesh(file, ball);
    const std::vector<double> planes{-9.5, 0.1, 3};
    for (const bool is_section : {false, true}) {
        const std::string out = path("o.dxf");
        const Finished result = is_section
                                    ? trisect({"section", file, "--plane", "z=0.1", "-o", out})
                                    : slice({file, "--heights", "-9.5,0.1,3", "-o", out});
        ASSERT_EQ(result.code, 0) << result.err;
        const std::string text = read(out);
        const auto found =
            ::trisect::slices(::trisect::Solid::from_mesh(ball), planes, ::trisect::SliceOptions());
        for (std::size_t i = 0; i < planes.size(); ++i) {
            if (is_section && i != 1) continue;
            const std::string layer = is_section ? "0_at_0"
                                                 : std::to_string(i) + (i == 0   ? "_at_-9.5"
                                                                        : i == 1 ? "_at_0.1"
                                                                                 : "_at_3");
            const ::trisect::detail::InputText source(text, "o.dxf", ::trisect::ReadLimits(),
                                                      false);
            const auto drawing =
                ::trisect::detail::read_dxf(source, {layer, {0, 0}, 1, [](double) { return 8U; }});
            EXPECT_TRUE(drawing.remarks.empty());
            EXPECT_EQ(in_order(drawing.shapes.at(0).outlines), loops_of(found[i])) << layer;
        }
        EXPECT_EQ(text.find("\n38\n0.1\n") != std::string::npos, !is_section);
    }
}

TEST_F(SliceCommand, JsonHasTheSameDoubles) {
    const ::trisect::PolygonMesh ball = ::trisect::make_icosphere(1, 1);
    const std::string file = path("ball.off");
    ::trisect::write_mesh(file, ball);
    ASSERT_EQ(slice({file, "--heights", "0.1", "-o", path("o.json")}).code, 0);
    const std::vector<double> planes{0.1};
    const auto found = ::trisect::slices(::trisect::Solid::from_mesh(ball), planes);
    Loops loops;
    const json layers = json::parse(read(path("o.json")));
    for (const json& region : layers["layers"][0]["regions"]) {
        loops.push_back(region["outer"].get<::trisect::Outline>());
        for (const json& hole : region["holes"]) loops.push_back(hole.get<::trisect::Outline>());
    }
    EXPECT_EQ(in_order(loops), loops_of(found[0]));
    // So has the drawing.
    ASSERT_EQ(slice({file, "--heights", "0.1", "-o", path("o.svg")}).code, 0);
    const std::string svg = read(path("o.svg"));
    for (const auto& point : found[0].points) {
        if (point[0] == 0 || point[1] == 0) continue;
        EXPECT_NE(svg.find(json(point[0]).dump() + "," + json(point[1]).dump()), std::string::npos);
    }
}

TEST_F(SliceCommand, StandardOutputIsTheOutput) {
    const Finished result = slice({cube_, "--count", "2", "-o", "-"});
    ASSERT_EQ(result.code, 0);
    EXPECT_TRUE(is_well_formed_xml(result.out));
    EXPECT_NE(result.err.find("2 layers, 2 regions, 2 loops, 8 corners, volume 8"),
              std::string::npos)
        << result.err;
    const Finished cli = slice({cube_, "--count", "2", "-o", "-", "--as", "cli"});
    EXPECT_TRUE(cli.out.starts_with("$$HEADERSTART")) << cli.err;
    EXPECT_NE(slice({cube_, "--count", "2"}).out.find("2 layers"), std::string::npos);
}

TEST_F(SliceCommand, NothingOfNothing) {
    const json document = report({cube_, shell_, "--op", "difference", "--step", "1"});
    EXPECT_EQ(document["layers"].size(), 0U);
    for (const char* name : {"n.svg", "n.dxf", "n.cli", "n.json"})
        EXPECT_EQ(
            slice({cube_, shell_, "--op", "difference", "--step", "1", "-o", path(name)}).code, 0)
            << name;
}

TEST_F(SliceCommand, MistakesAreUsageErrors) {
    for (const std::vector<std::string>& mistake :
         std::vector<std::vector<std::string>>{{},
                                               {"--step", "0"},
                                               {"--step", "-1"},
                                               {"--step", "thick"},
                                               {"--count", "0"},
                                               {"--count", "-4"},
                                               {"--count", "1.5"},
                                               {"--step", "1", "--count", "2"},
                                               {"--heights", "1,2", "--from", "0"},
                                               {"--step", "1", "--from", "2", "--to", "1"},
                                               {"--step", "1", "--axis", "w"},
                                               {"--step", "1", "--faces", "all"},
                                               {"--step", "1", "--as", "png"},
                                               {"--step", "1", "-o", path("s.png")},
                                               {"--step", "1", "-o", "-", "--json"}}) {
        std::vector<std::string> arguments{cube_};
        arguments.insert(arguments.end(), mistake.begin(), mistake.end());
        EXPECT_EQ(slice(arguments).code, 2) << testing::PrintToString(mistake);
    }
    const Finished missing = slice({cube_, "--heights", path("none.txt")});
    EXPECT_EQ(missing.code, 3) << missing.err;
    const Finished malformed = slice({cube_, "--heights", write("bad.txt", "1\n2 x\n")});
    EXPECT_EQ(malformed.code, 3);
    EXPECT_NE(malformed.err.find("bad.txt:2:3"), std::string::npos) << malformed.err;
    EXPECT_EQ(slice({cube_, "--count", "1000001"}).code, 5);
    EXPECT_EQ(slice({cube_, "--step", "1e-9"}).code, 5);
    EXPECT_EQ(slice({cube_, "--step", "1e-300"}).code, 5);
}

}  // namespace
