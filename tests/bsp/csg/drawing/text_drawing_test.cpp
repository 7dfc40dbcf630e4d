// SPDX-License-Identifier: Apache-2.0
//
// Which fonts there are is not known, so figures are those of any font.
#include <trisect/bsp/csg/drawing/glyph_shapes.h>
#include <trisect/bsp/csg/drawing/text_drawing.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "outline_area.h"

namespace trisect::detail {
namespace {

struct Box {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    double low = left;
    double high = -left;
};

Box box_of(const Drawing& drawing) {
    Box out;
    for (const DrawingShape& shape : drawing.shapes)
        for (const Outline& outline : shape.outlines)
            for (const Point2d& p : outline) {
                out.left = std::min(out.left, p[0]);
                out.right = std::max(out.right, p[0]);
                out.low = std::min(out.low, p[1]);
                out.high = std::max(out.high, p[1]);
            }
    return out;
}

class TextDrawing : public ::testing::Test {
protected:
    void SetUp() override {
        TextOptions options;
        options.text = "I";
        try {
            if (text_drawing(options).shapes.empty()) GTEST_SKIP() << "no font has letters";
        } catch (const UnsupportedError&) {
            GTEST_SKIP() << "there is no font";
        }
    }
    static Drawing drawing(const std::string& text, double size = 10,
                           const std::string& halign = "left",
                           const std::string& valign = "baseline") {
        TextOptions options;
        options.text = text;
        options.size = size;
        options.halign = halign;
        options.valign = valign;
        return text_drawing(options);
    }
};

TEST_F(TextDrawing, LettersAreAboutAsHighAsTheSize) {
    const Box box = box_of(drawing("H"));
    EXPECT_NEAR(box.high, 10, 2);
    EXPECT_NEAR(box.low, 0, 0.5);
    const Box twice = box_of(drawing("H", 20));
    EXPECT_NEAR(twice.high, 2 * box.high, 1e-12);
    EXPECT_NEAR(testing::area_of(drawing("H", -10)), testing::area_of(drawing("H")), 1e-9);
}

TEST(GlyphShapes, HolesAreOfTheSmallestShapeAroundThem) {
    const auto square = [](double low, double high, bool reversed) -> Outline {
        Outline out{{low, low}, {high, low}, {high, high}, {low, high}};
        if (reversed) std::swap(out[1], out[3]);
        return out;
    };
    // Clockwise as TrueType has it: a ring, a square in it, and a square that overlaps the ring.
    const auto shapes = glyph_shapes({square(0, 10, true), square(1, 9, false), square(3, 7, true),
                                      square(4, 6, false), square(8, 12, true)});
    ASSERT_EQ(shapes.size(), 3U);
    EXPECT_EQ(shapes[0].outlines.size(), 2U);
    EXPECT_EQ(shapes[1].outlines, (std::vector{square(3, 7, true), square(4, 6, false)}));
    EXPECT_EQ(shapes[2].outlines.size(), 1U);
}

TEST_F(TextDrawing, AShapeALetter) {
    EXPECT_EQ(drawing("HIH").shapes.size(), 3U);
    EXPECT_EQ(drawing("O").shapes[0].outlines.size(), 2U);
    EXPECT_TRUE(drawing("").shapes.empty());
    EXPECT_TRUE(drawing(" ").shapes.empty());
    EXPECT_TRUE(drawing("H", 0).shapes.empty());
}

TEST_F(TextDrawing, Alignment) {
    const Box left = box_of(drawing("HxH"));
    const Box center = box_of(drawing("HxH", 10, "center"));
    const Box right = box_of(drawing("HxH", 10, "right"));
    EXPECT_NEAR(left.left - center.left, center.left - right.left, 1e-9);
    EXPECT_LT(right.right, 1);
    const Box top = box_of(drawing("H", 10, "left", "top"));
    EXPECT_NEAR(top.high, 0, 0.5);
    const Box middle = box_of(drawing("H", 10, "left", "center"));
    EXPECT_NEAR(middle.high, -middle.low, 0.5);
}

TEST_F(TextDrawing, SegmentsOfCurves) {
    TextOptions options;
    options.text = "O";
    options.segments = 3;
    const std::size_t few = text_drawing(options).shapes[0].outlines[0].size();
    options.segments = 30;
    EXPECT_GT(text_drawing(options).shapes[0].outlines[0].size(), 5 * few);
}

TEST_F(TextDrawing, TextThatIsNotUtf8HasALetterOfItsOwn) {
    EXPECT_NO_THROW((void)drawing("\xff\xfe\x80"));
    EXPECT_THROW((void)drawing(std::string(20'000, 'a')), LimitError);
}

TEST_F(TextDrawing, AFontThatIsNotThereIsSaid) {
    TextOptions options;
    options.text = "H";
    options.font = "No Such Font At All:style=Bold";
    EXPECT_EQ(text_drawing(options).remarks.size(), 1U);
}

}  // namespace
}  // namespace trisect::detail
