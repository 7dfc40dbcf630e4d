// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/read_dxf.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "outline_area.h"

namespace trisect::detail {
namespace {

/// Words, one a line: codes and values.
std::string lines_of(const std::string& words) {
    std::istringstream in(words);
    std::string out;
    for (std::string word; in >> word;) out += word + "\n";
    return out;
}

Drawing drawing_of(const std::string& words, const std::string& layer = "", double scale = 1,
                   Point2d origin = {0, 0}) {
    const std::string text = lines_of(words + " 0 EOF");
    const InputText source(text, "f.dxf", ReadLimits(), false);
    return read_dxf(source, {layer, origin, scale, [](double) { return 8U; }});
}

std::string entities(const std::string& words) {
    return "0 SECTION 2 ENTITIES " + words + " 0 ENDSEC";
}

std::string line(double ax, double ay, double bx, double by, const std::string& layer = "0") {
    std::ostringstream out;
    out << "0 LINE 8 " << layer << " 10 " << ax << " 20 " << ay << " 11 " << bx << " 21 " << by
        << " ";
    return out.str();
}

const std::string triangle = line(0, 0, 4, 0) + line(4, 0, 0, 2) + line(0, 2, 0, 0);

TEST(ReadDxf, LinesAndPolylines) {
    EXPECT_EQ(testing::area_of(drawing_of(entities(triangle))), 4);
    const std::string polyline = "0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 10 4 20 0 10 0 20 2";
    EXPECT_EQ(testing::area_of(drawing_of(entities(polyline))), 4);
    EXPECT_EQ(testing::area_of(drawing_of(entities(triangle), "", 2, {1, 1})), 16);
}

TEST(ReadDxf, ArcsHaveTheSidesOfTheirPartOfACircle) {
    const Drawing circle = drawing_of(entities("0 CIRCLE 8 0 10 1 20 2 40 3"));
    ASSERT_EQ(circle.shapes[0].outlines.size(), 1U);
    EXPECT_EQ(circle.shapes[0].outlines[0].size(), 9U);
    EXPECT_EQ(circle.shapes[0].outlines[0][0], (Point2d{4, 2}));
    const Drawing arc = drawing_of(entities("0 ARC 8 0 10 0 20 0 40 1 50 270 51 10"));
    EXPECT_EQ(arc.shapes[0].outlines[0].size(), 4U);
    const Drawing ellipse =
        drawing_of(entities("0 ELLIPSE 8 0 10 0 20 0 11 0 21 2 40 0.5 41 0 42 6.283185307179586"));
    EXPECT_NEAR(testing::area_of(ellipse), 2 * 1 * 8 * 0.5 * 0.70710678, 1e-6);
}

TEST(ReadDxf, LayersAreChosen) {
    const std::string words =
        entities(triangle + line(0, 0, 1, 0, "b") + line(1, 0, 0, 1, "b") + line(0, 1, 0, 0, "b"));
    EXPECT_EQ(testing::area_of(drawing_of(words, "b")), 0.5);
    EXPECT_EQ(testing::area_of(drawing_of(words, "none")), 0);
}

TEST(ReadDxf, BlocksAreInserted) {
    const std::string block = "0 SECTION 2 BLOCKS 0 BLOCK 2 B " + triangle + "0 ENDBLK 0 ENDSEC ";
    const Drawing turned =
        drawing_of(block + entities("0 INSERT 8 0 2 B 10 5 20 7 41 2 42 3 50 90"));
    EXPECT_EQ(testing::area_of(turned), 24);
    EXPECT_EQ(turned.shapes[0].outlines[0][1], (Point2d{5, 15}));
}

TEST(ReadDxf, WhatIsLeftOutIsSaid) {
    const Drawing out = drawing_of(entities("0 SPLINE 8 0 10 0 20 0 0 SPLINE 8 0 " + triangle));
    ASSERT_EQ(out.remarks.size(), 1U);
    EXPECT_EQ(out.remarks[0], "2 of SPLINE left out");
    const Drawing bulge =
        drawing_of(entities("0 LWPOLYLINE 8 0 70 1 10 0 20 0 42 1 10 4 20 0 10 0 20 2"));
    EXPECT_EQ(bulge.remarks.size(), 1U);
}

TEST(ReadDxf, MalformedFilesAreRefusedWithTheirLine) {
    const auto line_of = [](const std::string& words) -> std::uint64_t {
        try {
            (void)drawing_of(words);
        } catch (const InputError& e) {
            return e.place().line;
        }
        return 0;
    };
    EXPECT_EQ(line_of(entities("x LINE")), 5U);
    EXPECT_EQ(line_of(entities("0 LINE 10 1,5")), 8U);
    EXPECT_EQ(line_of(entities("0 LINE 10 nan")), 8U);
    EXPECT_EQ(line_of(entities("0 LINE 8 0 ")), 6U);
    EXPECT_EQ(line_of(entities("0 CIRCLE 10 1")), 6U);
}

// Each insertion doubles the block.
TEST(ReadDxf, ABlockThatInsertsItselfIsLimited) {
    std::string words = "0 SECTION 2 BLOCKS 0 BLOCK 2 B " + triangle;
    for (int i = 0; i < 40; ++i) words += "0 INSERT 2 B 10 1 20 1 ";
    EXPECT_THROW((void)drawing_of(words + "0 ENDBLK 0 ENDSEC"), LimitError);
}

}  // namespace
}  // namespace trisect::detail
