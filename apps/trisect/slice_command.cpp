// SPDX-License-Identifier: Apache-2.0
//
// slice A --step H -o OUT: a stack of sections across an axis, found in one walk over the boundary.
#include "slice_command.h"

#include <trisect/brep/exact_mesh.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "choice.h"
#include "output_name.h"
#include "queried_set.h"
#include "values.h"

namespace trisect::app {
namespace {

const Choices<LayerFormat> layer_formats{{"svg", LayerFormat::Svg},
                                         {"dxf", LayerFormat::Dxf},
                                         {"cli", LayerFormat::Cli},
                                         {"json", LayerFormat::JsonText}};

/// By --as, or the name; a drawing else.
LayerFormat format_of(const SliceCommandOptions& options) {
    if (options.format) return *options.format;
    std::string found = std::filesystem::path(options.output).extension().string();
    std::transform(found.begin(), found.end(), found.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (found.empty()) return LayerFormat::Svg;
    for (const auto& [word, format] : layer_formats)
        if (found == "." + std::string(word)) return format;
    throw UsageError(fmt::format("{}: layers are written as {}, or as --as says", options.output,
                                 joined_words(layer_formats, ", ")));
}

void check_options(const Session& session, const SliceCommandOptions& options) {
    options.heights.check();
    if (options.output == "-" && session.options().json)
        throw UsageError("--json and '-o -' both want the standard output");
    if (!options.output.empty()) static_cast<void>(format_of(options));
    check_outputs(session, {options.output}, Answer::Printed);
}

/// Across y it looks along +y, so that x is to the right and z up, as in `section`.
SliceFrame frame_across(int axis) {
    return axis == 1 ? SliceFrame({0, -1, 0}) : SliceFrame::across(axis);
}

std::optional<std::array<double, 2>> ends_along(const ExactMesh& mesh, std::size_t axis) {
    const std::vector<Point3d> points = to_polygon_mesh(mesh).points;
    if (points.empty()) return std::nullopt;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::array<double, 2> out{infinite, -infinite};
    for (const Point3d& p : points) out = {std::min(out[0], p[axis]), std::max(out[1], p[axis])};
    return out;
}

Layer layer_of(const Slice& slice, double height) {
    Layer out;
    out.height = height;
    out.area = area(slice);
    out.perimeter = perimeter(slice);
    out.is_exact = slice.is_exact;
    for (const auto& region : slice.regions) {
        auto& loops = out.regions.emplace_back();
        for (const std::uint32_t l : region) {
            Outline& corners = loops.emplace_back();
            for (const std::uint32_t v : slice.loops[l]) corners.push_back(slice.points[v]);
        }
    }
    return out;
}

/// Planes across y are -y = -height, and what is below them is above.
LayerStack stack_of(const ExactMesh& mesh, const LayerHeights& heights,
                    const SliceCommandOptions& options, const EvaluateOptions& evaluation) {
    SliceOptions slicing;
    slicing.frame = frame_across(options.axis);
    slicing.rule = options.rule;
    slicing.evaluate = evaluation;
    std::vector<double> planes = heights.planes;
    if (options.axis == 1) {
        for (double& z : planes) z = -z;
        if (options.rule != SliceRule::Closed)
            slicing.rule = options.rule == SliceRule::Below ? SliceRule::Above : SliceRule::Below;
    }
    const std::vector<Slice> found = slices(mesh, planes, slicing);
    LayerStack out;
    out.axis = options.axis;
    for (std::size_t i = 0; i < found.size(); ++i) {
        Layer& layer = out.layers.emplace_back(layer_of(found[i], heights.planes[i]));
        if (!heights.steps.empty()) layer.step = heights.steps[i];
    }
    return out;
}

std::string text_of(const LayerStack& stack, LayerFormat format) {
    switch (format) {
        case LayerFormat::Dxf:
            return dxf_of_layers(stack);
        case LayerFormat::Cli:
            return cli_of_layers(stack);
        case LayerFormat::JsonText:
            return json_of_layers(stack);
        case LayerFormat::Svg:
            break;
    }
    return svg_of_layers(stack);
}

struct StackTotals {
    std::size_t regions = 0;
    std::size_t loops = 0;
    std::size_t corners = 0;
    double volume = 0;  ///< of all steps, each as thick as it is
};

Json layer_json(const Layer& layer, StackTotals& totals) {
    std::size_t loops = 0;
    std::size_t corners = 0;
    for (const auto& region : layer.regions) {
        loops += region.size();
        for (const Outline& loop : region) corners += loop.size();
    }
    Json entry;
    entry["height"] = layer.height;
    if (layer.step) entry["step"] = *layer.step;
    entry["regions"] = layer.regions.size();
    entry["loops"] = loops;
    entry["corners"] = corners;
    entry["area"] = layer.area;
    entry["perimeter"] = layer.perimeter;
    entry["exact"] = layer.is_exact;
    totals.regions += layer.regions.size();
    totals.loops += loops;
    totals.corners += corners;
    if (layer.step) totals.volume += layer.area * ((*layer.step)[1] - (*layer.step)[0]);
    return entry;
}

template <class Value, class Parse>
void add_number(CLI::App& command, const char* name, std::optional<Value>& value, Parse parse,
                const char* help, const char* type) {
    command
        .add_option_function<std::string>(
            name, [&value, parse, name](const std::string& s) { value = parse(s, name); }, help)
        ->type_name(type);
}

std::uint64_t parse_count(std::string_view text, std::string_view what) {
    const std::int64_t n = parse_integer(text, what);
    if (n < 1) throw UsageError(std::string(what) + ": must be positive");
    return static_cast<std::uint64_t>(n);
}

void add_height_options(CLI::App& command, HeightRequest& heights) {
    add_number(command, "--step", heights.step, parse_number,
               "thickness of layers; as many as have their middle below --to", "H");
    add_number(command, "--count", heights.count, parse_count,
               "how many layers, of equal thickness", "N");
    command
        .add_option("--heights", heights.heights,
                    "planes themselves: numbers with commas between, or a file of numbers")
        ->type_name("FILE");
    add_number(command, "--from", heights.from, parse_number,
               "where the first layer begins (default: where the solid does)", "Z");
    add_number(command, "--to", heights.to, parse_number,
               "where the last layer ends (default: where the solid does)", "Z");
    add_choice_option<PlaneIn>(
        command, "--at", heights.plane,
        {{"middle", PlaneIn::Middle}, {"bottom", PlaneIn::Bottom}, {"top", PlaneIn::Top}},
        "where in its layer a plane is (default: middle, as for printing)");
}

}  // namespace

void add_slice_command(CLI::App& app, SliceCommandOptions& options) {
    CLI::App* command =
        app.add_subcommand("slice", "layers of a solid, as drawings or for printing");
    add_query_options(*command, options.set);
    add_height_options(*command, options.heights);
    add_choice_option<int>(*command, "--axis", options.axis, {{"x", 0}, {"y", 1}, {"z", 2}},
                           "axis that planes are across (default: z)");
    add_choice_option<SliceRule>(
        *command, "--faces", options.rule,
        {{"closed", SliceRule::Closed}, {"below", SliceRule::Below}, {"above", SliceRule::Above}},
        "what counts where a face is in a plane: the face (default), what "
        "is right below it, or above it");
    command
        ->add_option("-o,--output", options.output,
                     "layers as SVG, DXF, CLI or JSON; '-' is the standard output")
        ->type_name("FILE");
    command
        ->add_option_function<std::string>(
            "--as",
            [&options](const std::string& text) {
                for (const auto& [word, format] : layer_formats)
                    if (word == text) options.format = format;
                if (!options.format)
                    throw UsageError("--as: '" + text + "' is none of " +
                                     joined_words(layer_formats, ", "));
            },
            "format of the output (default: by its name, else svg)")
        ->type_name(joined_words(layer_formats, "|"));
}

Outcome run_slice(Session& session, const SliceCommandOptions& options) {
    check_options(session, options);
    session.plan(5);
    const QueriedSet set = read_set(session, options.set);
    const EvaluateOptions evaluation = session.evaluation_options(options.set.operands);
    const ExactMesh mesh = session.interruptible_stage(
        "assemble", [&] { return set.solid.to_exact_mesh(evaluation.threads); });
    const auto ends = ends_along(mesh, static_cast<std::size_t>(options.axis));
    const LayerHeights heights = layer_heights(options.heights, ends);
    const LayerStack stack = session.interruptible_stage(
        "slice", [&] { return stack_of(mesh, heights, options, evaluation); });
    if (!options.output.empty())
        session.stage("write", [&] {
            session.write_output(options.output, text_of(stack, format_of(options)));
        });
    Outcome out;
    StackTotals totals;
    Json layers = Json::array();
    for (const Layer& layer : stack.layers) layers.push_back(layer_json(layer, totals));
    out.document["schema"] = "trisect.slice/1";
    describe_inputs(options.set, set, out.document);
    out.document["axis"] = std::string(1, static_cast<char>('x' + options.axis));
    out.document["output"] = options.output.empty() ? Json() : Json(options.output);
    out.document["regions"] = totals.regions;
    out.document["loops"] = totals.loops;
    out.document["corners"] = totals.corners;
    out.document["volume"] = heights.steps.empty() ? Json() : Json(totals.volume);
    out.document["layers"] = std::move(layers);
    out.document["seconds"] = session.seconds();
    std::string text =
        fmt::format("{} layers, {} regions, {} loops, {} corners", stack.layers.size(),
                    totals.regions, totals.loops, totals.corners);
    if (!heights.steps.empty()) text += ", volume " + number_text(totals.volume);
    (options.output == "-" ? out.remarks : out.answer) = text + '\n';
    return out;
}

}  // namespace trisect::app
