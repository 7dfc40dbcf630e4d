// SPDX-License-Identifier: Apache-2.0
//
// render A -o A.png: a picture of a solid, made by ray queries alone: no graphics system is needed.
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <charconv>

#include "choice.h"
#include "commands.h"
#include "output_name.h"
#include "queried_set.h"
#include "render_index_scene.h"
#include "render_picture.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint32_t largest_side = 16384;
constexpr std::uint64_t most_samples = std::uint64_t{1} << 27;

PixelSize parse_size(std::string_view text) {
    const auto x = text.find('x');
    if (x == std::string_view::npos) throw UsageError("--size: WIDTHxHEIGHT, such as 800x600");
    const std::int64_t width = parse_integer(text.substr(0, x), "--size");
    const std::int64_t height = parse_integer(text.substr(x + 1), "--size");
    if (width < 1 || height < 1 || width > largest_side || height > largest_side) {
        throw UsageError(fmt::format("--size: both numbers must be from 1 to {}", largest_side));
    }
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

double parse_opening(std::string_view text) {
    const double degrees = parse_number(text, "--perspective");
    if (degrees < 0 || degrees > 120) throw UsageError("--perspective: must be from 0 to 120");
    return degrees;
}

std::uint32_t parse_samples(std::string_view text) {
    const std::int64_t n = parse_integer(text, "--samples");
    if (n < 1 || n > 8) throw UsageError("--samples: must be from 1 to 8");
    return static_cast<std::uint32_t>(n);
}

/// Without --samples. Fine meshes have detail everywhere, so that smoother lines would cost several
/// rays for nearly every pixel.
constexpr std::uint32_t samples_by_size = 0;

std::uint32_t samples_for(const QueriedSet& set) {
    constexpr std::uint64_t many_triangles = 30'000;
    std::uint64_t triangles = 0;
    for (const Operand& operand : set.operands) {
        triangles += operand.facts["triangles"].get<std::uint64_t>();
    }
    return triangles > many_triangles ? 2 : 3;
}

void check_sample_count(const PictureStyle& style) {
    const std::uint64_t side = style.samples == samples_by_size ? 3 : style.samples;
    if (style.size.count() * side * side > most_samples) {
        throw UsageError("--size and --samples: so many samples need too much memory");
    }
}

/// The solid, or what a section leaves of it: the points below the plane.
Solid cut_open(Session& session, const RenderOptions& options, const QueriedSet& set) {
    if (!options.section) return set.solid;
    const Bounds bounds = bounds_of(corners_of(set.solid)).value_or(Bounds());
    const auto plane = options.section->coefficients(bounds);
    const EvaluateOptions evaluation = session.evaluation_options(options.set.operands);
    return session.interruptible_stage(
        "cut", [&] { return evaluate(set.solid & Solid::half_space(plane), evaluation); });
}

double diameter_of(const std::optional<Bounds>& bounds) {
    if (!bounds) return 1;
    const Eigen::Vector3d extent(bounds->hi[0] - bounds->lo[0], bounds->hi[1] - bounds->lo[1],
                                 bounds->hi[2] - bounds->lo[2]);
    return extent.norm() > 0 ? extent.norm() : 1;
}

Json size_json(PixelSize size) { return Json::array({size.width, size.height}); }

Json vector_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

void add_look_options(CLI::App& command, RenderOptions& o) {
    command
        .add_option_function<std::string>(
            "--size", [&o](const auto& s) { o.style.size = parse_size(s); },
            "of the picture in pixels (default 800x600)")
        ->type_name("WxH");
    command.add_option("--view", o.view, "from where to look (default iso)")
        ->type_name("iso|front|back|left|right|top|bottom|X,Y,Z");
    add_word_option(command, "--up", o.up, {"x", "y", "z"},
                    "which axis of the model points up (default z)");
    command
        .add_option_function<std::string>(
            "--perspective", [&o](const auto& s) { o.opening = parse_opening(s); },
            "opening of the lens; 0 (the default) is parallel rays")
        ->type_name("DEGREES");
    command
        .add_option_function<std::string>(
            "--samples", [&o](const auto& s) { o.style.samples = parse_samples(s); },
            "rays along the side of a pixel where there is detail (default 3, 2 for fine meshes)")
        ->type_name("N");
    add_choice_option<EdgeStyle>(
        command, "--edges", o.style.edges,
        {{"all", EdgeStyle::All}, {"auto", EdgeStyle::Auto}, {"none", EdgeStyle::None}},
        "edges drawn; auto fades shallow, crowded ones");
    add_choice_option<Background>(command, "--background", o.style.background,
                                  {{"light", Background::Light},
                                   {"white", Background::White},
                                   {"dark", Background::Dark},
                                   {"transparent", Background::Transparent}},
                                  "what is behind (default light)");
}

}  // namespace

void add_render_command(CLI::App& app, RenderOptions& options) {
    options.style.samples = samples_by_size;
    CLI::App* command = app.add_subcommand("render", "a picture (PNG); needs no graphics system");
    add_query_options(*command, options.set);
    command->add_option("-o,--output", options.output, "PNG file; '-' is the standard output")
        ->required()
        ->type_name("FILE");
    command
        ->add_option_function<std::string>(
            "--section",
            [&options](const auto& s) {
                options.section = PlaneRequest::from_text(s, "--section");
            },
            "cut the solid open: keep what is below a plane; a short form cuts in the middle")
        ->type_name("A,B,C,D|z=NUMBER|z");
    add_look_options(*command, options);
}

Outcome run_render(Session& session, const RenderOptions& options) {
    check_output_name(session, options.output, ".png");
    check_outputs(session, {options.output});
    check_sample_count(options.style);
    const View view = View::from_text(options.view, options.up);
    session.plan(6);
    const QueriedSet set = read_set(session, options.set);
    const Solid solid = cut_open(session, options, set);
    const BrepIndex index = session.stage("index", [&] { return BrepIndex(solid); });
    std::vector<Point3d> corners = session.stage("fit", [&] { return corners_of(solid); });
    if (corners.empty()) {
        session.note("the set is empty: the picture shows nothing");
        corners.push_back(Point3d{});
    }
    const Camera camera = Camera::fitted(view, corners, options.style.size, {options.opening});
    const IndexScene scene(index, set, diameter_of(bounds_of(corners)));
    PictureStyle style = options.style;
    if (style.samples == samples_by_size) style.samples = samples_for(set);
    const Picture picture =
        session.stage("draw", [&] { return draw_picture(scene, camera, style); });
    session.stage("write", [&] { session.write_output(options.output, png_bytes(picture.image)); });
    Outcome out;
    out.document["schema"] = "trisect.render/1";
    describe_inputs(options.set, set, out.document);
    out.document["output"] = options.output;
    out.document["size"] = size_json(options.style.size);
    out.document["eye"] = vector_json(camera.eye());
    out.document["forward"] = vector_json(camera.view().forward);
    out.document["up"] = vector_json(camera.view().up);
    out.document["samples"] = style.samples;
    out.document["rays"] = picture.rays;
    out.document["pixels_hit"] = picture.covered;
    out.document["seconds"] = session.seconds();
    out.remarks = fmt::format("{}: {} rays, {} of {} pixels hit", options.output, picture.rays,
                              picture.covered, options.style.size.count());
    return out;
}

}  // namespace trisect::app
