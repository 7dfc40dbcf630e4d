// SPDX-License-Identifier: Apache-2.0
//
// convert A -o B: another format, another place. Without a transform coordinates and polygons pass
// as they are, whether or not they bound a solid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "commands.h"
#include "exact_map.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "operand.h"
#include "output_name.h"
#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

/// In the order of the help text: matrix, scale, rotate, translate.
ExactMap map_of(const ConvertOptions& options) {
    ExactMap map;
    if (!options.matrix.empty()) map = ExactMap::from_file(options.matrix);
    if (options.scale) map = map.then(ExactMap::scaling(*options.scale));
    if (options.rotate) map = map.then(ExactMap::rotation(*options.rotate));
    if (options.translate) map = map.then(ExactMap::translation(*options.translate));
    if (map.orientation() == 0) throw UsageError("the transform makes space flat");
    return map;
}

/// --lattice: every coordinate to the nearest point of it.
LatticeReport round_to_lattice(PolygonMesh& mesh, Lattice lattice) {
    LatticeReport report;
    const std::vector<LatticePoint> rounded = to_lattice(mesh.points, lattice, report);
    std::transform(rounded.begin(), rounded.end(), mesh.points.begin(),
                   [&](const LatticePoint& p) { return to_user(p, lattice); });
    return report;
}

LatticeReport round_to_lattice(Model& model, Lattice lattice) {
    LatticeReport sum;
    sum.lattice = lattice;
    for (ModelPart& part : model.parts) {
        const LatticeReport report = round_to_lattice(part.mesh, lattice);
        sum.lossless = sum.lossless && report.lossless;
        sum.moved += report.moved;
        sum.max_move = std::max(sum.max_move, report.max_move);
        sum.flipped_faces += report.flipped_faces;
    }
    return sum;
}

RoundingReport apply(const ExactMap& map, Model& model) {
    RoundingReport sum;
    for (ModelPart& part : model.parts) {
        const RoundingReport report = map.apply(part);
        sum.moved += report.moved;
        sum.max_move = std::max(sum.max_move, report.max_move);
    }
    return sum;
}

Json rounding_json(std::size_t moved, double max_move) {
    Json out;
    out["moved"] = moved;
    out["max_move"] = max_move;
    return out;
}

/// How far corners are from the planes that a STEP file states for their faces.
Json planes_json(const ModelReport& report) {
    Json out;
    out["corners_off"] = report.off_plane_corners;
    out["largest_distance"] = report.largest_plane_distance;
    return out;
}

Json written_json(const WriteReport& report) {
    Json out;
    out["lossless"] = report.lossless;
    out["rounded_vertices"] = report.rounded_vertices;
    out["largest_move"] = report.largest_move;
    out["merged_vertices"] = report.merged_vertices;
    return out;
}

void add_transform_options(CLI::App& command, ConvertOptions& o) {
    command.add_option("--matrix", o.matrix, "file of twelve numbers: the 3x4 matrix, row by row")
        ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--scale", [&o](const auto& s) { o.scale = parse_number(s, "--scale"); },
            "factor; negative ones mirror at the origin")
        ->type_name("S");
    command
        .add_option_function<std::string>(
            "--rotate", [&o](const auto& s) { o.rotate = parse_tuple<4>(s, "--rotate"); },
            "axis and angle")
        ->type_name("X,Y,Z,DEGREES");
    command
        .add_option_function<std::string>(
            "--translate", [&o](const auto& s) { o.translate = parse_tuple<3>(s, "--translate"); },
            "vector")
        ->type_name("X,Y,Z");
}

bool has_transform(const ConvertOptions& options) {
    return !options.matrix.empty() || options.scale || options.rotate || options.translate;
}

/// Native files and exact boundaries are of solids: the input must bound one, and keeps what it is
/// to the last bit.
Outcome run_lossless_convert(Session& session, const ConvertOptions& options) {
    if (has_transform(options))
        throw UsageError(options.output + ": transforms are for meshes; convert to one first");
    check_outputs(session, {options.output});
    session.plan(2);
    const std::vector<Operand> read = session.stage("read", [&] {
        return read_operands(session, std::array{options.input}, OperandOptions());
    });
    session.stage("write", [&] { write_lossless_output(session, options.output, read[0].solid); });
    Outcome out;
    out.document["schema"] = "trisect.convert/1";
    out.document["input"] = options.input;
    out.document["output"] = options.output;
    out.document["format"] = has_native_name(options.output) ? "trisect" : "exact";
    out.document.update(read[0].facts);
    out.document.erase("file");
    out.document["seconds"] = session.seconds();
    return out;
}

Outcome run_mesh_convert(Session& session, const ConvertOptions& options) {
    const MeshFormat format = output_format(session, options.output);
    check_outputs(session, {options.output});
    if (options.properties) check_holds_properties(options.output, format);
    const ExactMap map = map_of(options);
    session.plan(3);
    InputModel input = session.stage(
        "read", [&] { return read_input_model(session, options.input, options.properties); });
    Model& model = input.model;
    note_model(session, options.input, model.unit, input.report);
    const RoundingReport moved = session.stage("transform", [&] { return apply(map, model); });
    Outcome out;
    out.document["schema"] = "trisect.convert/1";
    out.document["input"] = options.input;
    out.document["output"] = options.output;
    out.document["format"] = to_string(format);
    std::size_t vertices = 0;
    std::size_t faces = 0;
    for (const ModelPart& part : model.parts) {
        vertices += part.mesh.points.size();
        faces += part.mesh.face_count();
    }
    out.document["vertices"] = vertices;
    out.document["faces"] = faces;
    if (holds_models(input.format)) {
        out.document.update(model_json(model));
        out.document["placed"] =
            rounding_json(input.report.rounded_vertices, input.report.largest_move);
        if (input.format == MeshFormat::Step) out.document["planes"] = planes_json(input.report);
    }
    out.document["matrix"] = map.rows();
    out.document["rounding"] = rounding_json(moved.moved, moved.max_move);
    if (moved.moved != 0) {
        session.note(fmt::format("{}: {} vertices rounded by the transform, by at most {}",
                                 options.output, moved.moved, number_text(moved.max_move)));
    }
    out.document["lattice"] = Json();
    if (session.options().lattice) {
        const LatticeReport report = round_to_lattice(model, Lattice{*session.options().lattice});
        out.document["lattice"] = lattice_json(report);
        note_rounding(session, report, options.output);
    }
    const WriteReport written = session.stage("write", [&] {
        return write_output_model(session, options.output, format, std::move(model),
                                  options.properties);
    });
    out.document["written"] = written_json(written);
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace

void add_convert_command(CLI::App& app, ConvertOptions& options) {
    CLI::App* command = app.add_subcommand(
        "convert",
        "write another format; transforms apply in the order matrix, scale, rotate, "
        "translate");
    command
        ->add_option("A", options.input,
                     "mesh file, exact boundary (.exact) or native file (.trisect)")
        ->required();
    command
        ->add_option(
            "-o,--output", options.output,
            "mesh, exact boundary (.exact) or native file (.trisect); '-' is the standard output")
        ->required();
    add_properties_option(*command, options.properties);
    add_transform_options(*command, options);
}

Outcome run_convert(Session& session, const ConvertOptions& options) {
    return has_lossless_name(options.output) ? run_lossless_convert(session, options)
                                             : run_mesh_convert(session, options);
}

}  // namespace trisect::app
