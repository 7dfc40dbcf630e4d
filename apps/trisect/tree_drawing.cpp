// SPDX-License-Identifier: Apache-2.0
//
// From back to front: the cells, coloured by what is known of them without looking further; the
// walls; the solid; the outlines of the operands.
#include "tree_drawing.h"

#include <algorithm>
#include <array>

namespace trisect::app {
namespace {

constexpr double drawing_pixels = 760;
constexpr double footer_pixels = 34;

SvgStyle filled(Color fill) {
    SvgStyle style;
    style.fill = fill;
    return style;
}

SvgStyle stroked(Color stroke, double width) {
    SvgStyle style;
    style.stroke = stroke;
    style.stroke_width = width;
    return style;
}

constexpr Color outside_color{0xffffff};
constexpr Color inside_color{0xd6e4f3};
constexpr Color listing_color{0xfdf3d3};
constexpr Color arranged_color{0xfcdca4};
constexpr Color wall_color{0x8a949f};

struct KindLook {
    SliceCell::Kind kind;
    Color color;
    const char* word;
};

constexpr std::array<KindLook, 4> kind_looks{{
    {SliceCell::Kind::Outside, outside_color, "outside"},
    {SliceCell::Kind::Inside, inside_color, "inside"},
    {SliceCell::Kind::Listing, listing_color, "lists polygons"},
    {SliceCell::Kind::Arranged, arranged_color, "operands meet"},
}};

std::vector<Svg::Rectangle> boxes_of(const Slice& slice, SliceCell::Kind kind) {
    std::vector<Svg::Rectangle> boxes;
    for (const SliceCell& cell : slice.cells) {
        if (cell.kind == kind) boxes.push_back(cell.box);
    }
    return boxes;
}

/// \return where the legend goes on.
double draw_cells(const Slice& slice, Svg& svg) {
    double left = 10;
    for (const KindLook& look : kind_looks) {
        const auto boxes = boxes_of(slice, look.kind);
        if (boxes.empty()) continue;
        svg.rectangles(boxes, filled(look.color));
        SvgStyle square = filled(look.color);
        square.stroke = wall_color;
        left = svg.legend(left, look.word, square);
    }
    std::vector<Svg::Rectangle> all;
    all.reserve(slice.cells.size());
    for (const SliceCell& cell : slice.cells) all.push_back(cell.box);
    // Many walls are drawn thinner, or they would hide everything else.
    const double width =
        std::clamp(14.0 / std::max(1.0, static_cast<double>(all.size())), 0.7, 1.0);
    svg.rectangles(all, stroked(wall_color, width));
    return left;
}

}  // namespace

std::string draw_slice(const Slice& slice, const DrawingFrame& frame) {
    Svg svg(frame, drawing_pixels, footer_pixels, "A slice through the partition of a solid",
            Svg::Numbers::Compact);
    const double left = draw_cells(slice, svg);
    SvgStyle solid = stroked(ink, 1.8);
    solid.fill = operand_color(0);
    solid.fill_opacity = 0.55;
    svg.polygons(slice.section, solid);
    if (!slice.section.empty()) svg.legend(left, "the solid", solid);
    for (const SliceOutline& operand : slice.operands) {
        svg.polygons(operand.loops, stroked(operand_line_color(operand.color), 1.4));
    }
    return svg.document();
}

}  // namespace trisect::app
