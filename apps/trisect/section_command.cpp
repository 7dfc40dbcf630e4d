// SPDX-License-Identifier: Apache-2.0
//
// section A --plane P -o S.svg|S.dxf: the points of a solid in a plane, as loops. The loops are
// exact; what is printed and drawn are their corners, each coordinate rounded once.
#include <trisect/bsp/brep_index.h>

#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "layer_stack.h"
#include "output_name.h"
#include "queried_set.h"
#include "section_drawing.h"
#include "svg.h"
#include "values.h"

namespace trisect::app {
namespace {

Json points_json(const SectionLoop& loop) {
    Json list = Json::array();
    for (const auto& point : loop.rounded) list.push_back(point);
    return list;
}

Json regions_json(const std::vector<SectionRegion>& regions, const PlaneFrame& frame) {
    Json list = Json::array();
    for (const SectionRegion& region : regions) {
        Json entry;
        entry["area"] = frame.area(region);
        entry["outer"] = points_json(region.outer);
        entry["holes"] = Json::array();
        for (const SectionLoop& hole : region.holes) entry["holes"].push_back(points_json(hole));
        list.push_back(std::move(entry));
    }
    return list;
}

struct Totals {
    std::size_t loops = 0;
    std::size_t corners = 0;
    double area = 0;
};

Totals totals_of(const std::vector<SectionRegion>& regions, const PlaneFrame& frame) {
    Totals totals;
    for (const SectionRegion& region : regions) {
        totals.loops += 1 + region.holes.size();
        totals.corners += region.outer.points.size();
        for (const SectionLoop& hole : region.holes) totals.corners += hole.points.size();
        totals.area += frame.area(region);
    }
    return totals;
}

std::string drawing_of(const std::vector<SectionRegion>& regions, const PlaneFrame& frame) {
    DrawingFrame around = DrawingFrame::empty();
    for (const SectionRegion& region : regions) {
        for (const DrawingPoint& p : frame.loop(region.outer)) around.add(p);
    }
    Svg svg(around.with_margin(0.04), 800, 0, "Section", Svg::Numbers::Precise);
    SvgStyle style;
    style.fill = operand_color(0);
    style.stroke = ink;
    style.stroke_width = 1.2;
    for (const SectionRegion& region : regions) svg.polygons(frame.loops(region), style);
    return svg.document();
}

bool is_dxf(const std::string& name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    return extension == ".dxf" || extension == ".DXF";
}

/// Outlines flat on one layer, as the drawing has them.
std::string dxf_of(const std::vector<SectionRegion>& regions, const PlaneFrame& frame) {
    LayerStack stack;
    Layer& layer = stack.layers.emplace_back();
    for (const SectionRegion& region : regions) layer.regions.push_back(frame.loops(region));
    return dxf_of_layers(stack);
}

}  // namespace

void add_section_command(CLI::App& app, SectionOptions& options) {
    CLI::App* command = app.add_subcommand("section", "the loops in which a plane cuts a solid");
    add_query_options(*command, options.set);
    command
        ->add_option_function<std::string>(
            "--plane",
            [&options](const auto& s) { options.plane = PlaneRequest::from_text(s, "--plane"); },
            "a x + b y + c z + d = 0, or an axis it is perpendicular to, by default in the middle")
        ->required()
        ->type_name("A,B,C,D|z=NUMBER|z");
    command
        ->add_option(
            "-o,--output", options.output,
            "drawing (SVG or DXF) in the coordinates of the plane; '-' is the standard output, "
            "as SVG")
        ->type_name("FILE");
}

Outcome run_section(Session& session, const SectionOptions& options) {
    const bool writes_dxf = is_dxf(options.output);
    check_output_name(session, options.output, writes_dxf ? ".dxf" : ".svg");
    check_outputs(session, {options.output}, Answer::Printed);
    session.plan(5);
    const QueriedSet set = read_set(session, options.set);
    const BrepIndex index = session.stage("index", [&] { return BrepIndex(set.solid); });
    const auto coefficients =
        options.plane.coefficients(bounds_of(corners_of(set.solid)).value_or(Bounds()));
    const PlaneFrame frame(coefficients);
    const std::vector<SectionRegion> regions =
        session.stage("section", [&] { return index.section(coefficients); });
    if (!options.output.empty()) {
        session.stage("write", [&] {
            session.write_output(options.output,
                                 writes_dxf ? dxf_of(regions, frame) : drawing_of(regions, frame));
        });
    }
    const Totals totals = totals_of(regions, frame);
    Outcome out;
    out.document["schema"] = "trisect.section/1";
    describe_inputs(options.set, set, out.document);
    out.document["plane"] = coefficients;
    out.document["right"] = frame.right();
    out.document["up"] = frame.up();
    out.document["output"] = options.output.empty() ? Json() : Json(options.output);
    out.document["loops"] = totals.loops;
    out.document["corners"] = totals.corners;
    out.document["area"] = totals.area;
    out.document["regions"] = regions_json(regions, frame);
    out.document["seconds"] = session.seconds();
    const std::string text =
        fmt::format("{} regions, {} loops, {} corners, area {}\n", regions.size(), totals.loops,
                    totals.corners, number_text(totals.area));
    (options.output == "-" ? out.remarks : out.answer) = text;
    return out;
}

}  // namespace trisect::app
