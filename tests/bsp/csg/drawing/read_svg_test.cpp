// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/read_svg.h>

#include <gtest/gtest.h>

#include <string>

#include "outline_area.h"

namespace trisect::detail {
namespace {

constexpr const char* page = "width='100mm' height='50mm' viewBox='0 0 100 50'";

Drawing svg_of(const std::string& body, const std::string& head = page,
               const SvgOptions& options = {}) {
    const std::string text =
        "<svg xmlns='http://www.w3.org/2000/svg' " + head + ">" + body + "</svg>";
    const InputText source(text, "f.svg", ReadLimits(), false);
    return read_svg(source, options);
}

const Outline& first_outline(const Drawing& drawing) { return drawing.shapes[0].outlines[0]; }

const std::string rectangle = "<rect x='10' y='5' width='20' height='10'/>";

TEST(ReadSvg, YGoesUpFromTheLowerLeftCornerOfThePage) {
    EXPECT_EQ(first_outline(svg_of(rectangle)), (Outline{{10, 45}, {30, 45}, {30, 35}, {10, 35}}));
    const Drawing inches = svg_of(rectangle, "width='2in' height='1in' viewBox='0 0 100 50'");
    EXPECT_NEAR(first_outline(inches)[0][0], 5.08, 1e-12);
    EXPECT_NEAR(first_outline(inches)[0][1], 22.86, 1e-12);
    const Drawing pixels = svg_of(rectangle, "width='100' height='50'", {96, false});
    EXPECT_EQ(first_outline(pixels)[0][0], 10);
    EXPECT_NEAR(first_outline(pixels)[0][1], 50 * 25.4 / 96 - 5, 1e-12);
    const Drawing none = svg_of(rectangle, "");
    EXPECT_EQ(first_outline(none)[0], (Point2d{10, -5}));
    const Drawing offset = svg_of(rectangle, "width='100mm' height='50mm' viewBox='5 5 100 50'");
    EXPECT_EQ(first_outline(offset)[0], (Point2d{5, 50}));
}

TEST(ReadSvg, TheViewBoxFitsThePage) {
    const std::string head = "width='100mm' height='100mm' viewBox='0 0 100 50' ";
    EXPECT_EQ(first_outline(svg_of(rectangle, head))[0], (Point2d{10, 70}));
    EXPECT_EQ(first_outline(svg_of(rectangle, head + "preserveAspectRatio='none'"))[0],
              (Point2d{10, 90}));
    EXPECT_EQ(first_outline(svg_of(rectangle, head + "preserveAspectRatio='xMinYMax slice'"))[0],
              (Point2d{20, 90}));
    EXPECT_EQ(first_outline(svg_of(rectangle, page, {72, true}))[0], (Point2d{-10, 5}));
}

TEST(ReadSvg, Transformations) {
    const auto corner = [](const std::string& text) {
        return first_outline(
            svg_of("<rect x='1' y='2' width='3' height='4' transform='" + text + "'/>"))[0];
    };
    EXPECT_EQ(corner("rotate(90 10 10)"), (Point2d{18, 49}));
    EXPECT_EQ(corner("matrix(1 2 3 4 5 6)"), (Point2d{12, 34}));
    EXPECT_EQ(corner("translate(10,5) scale(2) rotate(90)"), (Point2d{6, 43}));
    EXPECT_NEAR(corner("skewX(30)")[0], 2.1547, 1e-4);
    EXPECT_THROW((void)corner("bend(1)"), InputError);
    EXPECT_THROW((void)corner("rotate(1 2)"), InputError);
}

TEST(ReadSvg, PathsWithCurves) {
    EXPECT_EQ(testing::area_of(svg_of("<path d='M10 10 h10 v10 z'/>")), 50);
    EXPECT_EQ(testing::area_of(svg_of("<path d='m10,10l10,0 0,10Z'/>")), 50);
    EXPECT_EQ(testing::area_of(svg_of("<path d='M10 10H20V20Zl0 -10 10 0z'/>")), 100);
    EXPECT_EQ(first_outline(svg_of("<path d='M10 10C10 20 20 20 20 10z'/>")).size(), 21U);
    EXPECT_EQ(first_outline(svg_of("<path d='M0 0Q5 5 10 0T20 0z'/>")).size(), 41U);
    EXPECT_EQ(first_outline(svg_of("<path d='M0 0S5 5 10 0 15-5 20 0z'/>")).size(), 41U);
    const Outline arc = first_outline(svg_of("<path d='M10 10a5 5 0 0110 0z'/>"));
    EXPECT_EQ(arc.size(), 15U);
    EXPECT_NEAR(arc[7][0], 15, 1e-12);
    EXPECT_NEAR(arc[7][1], 45, 1e-12);
    EXPECT_THROW((void)svg_of("<path d='L1 1'/>"), InputError);
    EXPECT_THROW((void)svg_of("<path d='M1 1 K2 2'/>"), InputError);
    EXPECT_THROW((void)svg_of("<path d='M1 1 L2'/>"), InputError);
    EXPECT_THROW((void)svg_of("<path d='M1 1 z 2 2'/>"), InputError);
}

TEST(ReadSvg, OpenPathsAreStrokes) {
    const Drawing out = svg_of(
        "<line x1='1' y1='1' x2='9' y2='1' style='stroke-width: 2; stroke-linecap: butt'/>"
        "<polyline points='0,0 5,0 5,5'/><polyline points='0,0 5,0 5,5 0,0.05'/>");
    ASSERT_EQ(out.shapes.size(), 3U);
    EXPECT_EQ(out.shapes[0].strokes[0].size(), 1U);
    EXPECT_EQ(testing::signed_area(out.shapes[0].strokes[0][0]), -16);
    EXPECT_EQ(out.shapes[1].strokes[0].size(), 3U);
    EXPECT_TRUE(out.shapes[2].strokes.empty());
}

TEST(ReadSvg, WhatIsLeftOutIsSaid) {
    const Drawing out =
        svg_of("<defs>" + rectangle + "</defs><text>a</text><g>" + rectangle + "</g>");
    EXPECT_EQ(out.shapes.size(), 1U);
    ASSERT_EQ(out.remarks.size(), 1U);
    EXPECT_EQ(out.remarks[0], "1 of <text> left out");
}

TEST(ReadSvg, MalformedFilesAreRefused) {
    EXPECT_THROW((void)svg_of("<rect x='10%' y='1' width='1' height='1'/>"), InputError);
    EXPECT_THROW((void)svg_of("<svg/>"), InputError);
    EXPECT_THROW((void)svg_of("<polygon points='1 2 3'/>"), InputError);
    EXPECT_THROW((void)svg_of(rectangle, "viewBox='0 0 0 1'"), InputError);
    EXPECT_THROW((void)svg_of(rectangle, "width='1em'"), InputError);
    EXPECT_THROW((void)svg_of("<g>"), InputError);
    const InputText source("<html/>", "f.svg", ReadLimits(), false);
    EXPECT_THROW((void)read_svg(source, {}), InputError);
}

}  // namespace
}  // namespace trisect::detail
