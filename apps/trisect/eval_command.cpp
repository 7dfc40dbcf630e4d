// SPDX-License-Identifier: Apache-2.0
//
// eval MODEL.csg -o OUT: the set that a program in OpenSCAD's evaluated form describes.
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/csg/csg_evaluate.h>

#include <fmt/format.h>

#include "commands.h"
#include "mesh_files.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;

CsgTree read_program(const std::string& name) {
    const FileBytes bytes = name == "-" ? read_descriptor(0, "standard input", most_bytes)
                                        : read_file(name, most_bytes);
    return parse_csg(bytes.view(), name == "-" ? "standard input" : name);
}

void write_result(Session& session, const std::string& output, const Solid& solid,
                  const ExactMesh& mesh) {
    if (has_exact_boundary(output))
        return session.write_output(output, exact_text(solid.to_brep()));
    write_output_mesh(session, output, output_format(session, output), to_polygon_mesh(mesh));
}

std::string summary_of(const CsgReport& report, const Json& document) {
    double total = 0;
    for (const auto& seconds : document["seconds"]) total += seconds.get<double>();
    return fmt::format(
        "{:<13}{}\n{:<13}{}, {} different\n{:<13}{}\n{:<13}{}\n{:<13}{}\n{:<13}{:.3f} s", "nodes",
        report.nodes, "shapes", report.leaves, report.meshes, "formulas", report.evaluations,
        "triangles", document["triangles"].get<std::size_t>(), "volume",
        number_text(document["volume"].get<double>()), "time", total);
}

}  // namespace

void add_eval_command(CLI::App& app, EvalOptions& options) {
    CLI::App* command = app.add_subcommand(
        "eval", "the solid of a program in OpenSCAD's evaluated form (.csg), exactly");
    command->add_option("MODEL", options.input, ".csg file; '-' is the standard input")->required();
    command
        ->add_option("-o,--output", options.output,
                     "mesh, or exact boundary (.exact); '-' is the standard output")
        ->required();
    command->add_flag("--summary", options.summary,
                      "also numbers of nodes and shapes, volume and time");
}

Outcome run_eval(Session& session, const EvalOptions& options) {
    if (!has_exact_boundary(options.output)) (void)output_format(session, options.output);
    check_outputs(session, {options.output});
    session.plan(4);
    const CsgTree tree = session.stage("read", [&] { return read_program(options.input); });
    CsgReport report;
    const Solid solid = session.interruptible_stage("evaluate", [&] {
        CsgOptions how;
        how.evaluate = session.evaluation_options(OperandOptions());
        return evaluate_csg(tree, how, &report);
    });
    for (const std::string& remark : report.remarks) session.note(remark);
    if (report.is_flat)
        session.note("the program describes a region of the plane: its prism of height 1");
    Outcome out;
    // Assembled once: measures and the output take the same triangles.
    const ExactMesh mesh = session.interruptible_stage("measure", [&] {
        ExactMesh boundary = solid.to_exact_mesh();
        out.document["schema"] = "trisect.eval/1";
        out.document["input"] = options.input;
        out.document["output"] = options.output;
        out.document["nodes"] = report.nodes;
        out.document["shapes"] = report.leaves;
        out.document["different_shapes"] = report.meshes;
        out.document["formulas"] = report.evaluations;
        out.document["flat"] = report.is_flat;
        out.document["triangles"] = boundary.triangles.size();
        out.document["volume"] = volume(boundary);
        out.document["remarks"] = report.remarks;
        return boundary;
    });
    session.stage("write", [&] { write_result(session, options.output, solid, mesh); });
    out.document["seconds"] = session.seconds();
    if (options.summary) out.remarks = summary_of(report, out.document);
    return out;
}

}  // namespace trisect::app
