// SPDX-License-Identifier: Apache-2.0
//
// eval MODEL -o OUT: the set that a program describes, in OpenSCAD's evaluated form or in JSON.
#include <trisect/brep/measure.h>
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_session.h>
#include <trisect/bsp/csg/grid/csg_openscad_grid.h>
#include <trisect/kernel/error.h>

#include <chrono>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "certificate.h"
#include "choice.h"
#include "commands.h"
#include "eval_model.h"
#include "eval_program.h"
#include "eval_report.h"
#include "mesh_files.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {
namespace {

/// Of the mesh that is written.
struct EvalCertificate {
    std::optional<Certificate> certificate;
    std::optional<Mending> mending;
};

bool is_mesh(const std::string& output) { return !has_lossless_name(output); }

/// Checks the triangles as the format holds them, and mends those that meet. Faces of
/// STEP are written as they are.
EvalCertificate certified(const Session& session, const EvalOptions& options, ExactMesh& exact,
                          PolygonMesh& mesh) {
    EvalCertificate out;
    if (!options.certificate || !is_mesh(options.output)) return out;
    const MeshFormat format = output_format(session, options.output);
    out.certificate = certify_output(exact, mesh, format);
    if (format == MeshFormat::Step) return out;
    out.mending = mend_output(mesh, exact.source, *out.certificate, format);
    return out;
}

/// Whether the output shows what color() says.
bool keeps_colors(const Session& session, const EvalOptions& options, const CsgTree& tree) {
    return is_mesh(options.output) && has_colors(tree) &&
           holds_colors(output_format(session, options.output));
}

void write_colored(Session& session, const std::string& output, MeshFormat format,
                   const PolygonMesh& mesh, std::span<const FaceSource> sources,
                   const CsgReport& report) {
    write_output_model(session, output, format, colored_model(mesh, sources, report, "model"),
                       holds_properties(format));
}

/// `sources`: of the mesh's faces.
void write_result(Session& session, const std::string& output, const Solid& solid,
                  const PolygonMesh& mesh, std::span<const FaceSource> sources,
                  const CsgReport& report) {
    if (has_lossless_name(output)) return write_lossless_output(session, output, solid);
    const MeshFormat format = output_format(session, output);
    const bool has_color = !report.color_of_source.empty() && holds_colors(format);
    if (format == MeshFormat::Step) {
        MeshMap map;
        const PolygonMesh polygons = output_polygons(solid.to_brep(), format, &map);
        if (has_color) return write_colored(session, output, format, polygons, map.source, report);
        write_output_mesh(session, output, format, polygons);
    } else if (has_color) {
        write_colored(session, output, format, mesh, sources, report);
    } else {
        write_output_mesh(session, output, format, mesh);
    }
}

}  // namespace

void add_eval_command(CLI::App& app, EvalOptions& options) {
    CLI::App* command = app.add_subcommand(
        "eval", "the solid of a program in OpenSCAD's evaluated form (.csg) or in JSON, exactly");
    command
        ->add_option("MODEL", options.input,
                     ".csg or .json file, or .scad file, which an installed OpenSCAD evaluates; "
                     "'-' is the standard input")
        ->required();
    command
        ->add_option("-o,--output", options.output,
                     "mesh, exact boundary (.exact) or native file (.trisect), or the program "
                     "itself (.json); '-' is the standard output")
        ->required();
    add_choice_option<ProgramForm>(*command, "--program", options.form,
                                   {{"csg", ProgramForm::CsgText},
                                    {"json", ProgramForm::JsonText},
                                    {"scad", ProgramForm::Scad}},
                                   "how the program is written, whatever its name");
    command->add_option("--openscad", options.openscad,
                        "the OpenSCAD that evaluates .scad files (default: that of "
                        "TRISECT_OPENSCAD, or openscad on PATH)");
    command
        ->add_option("-D,--define", options.definitions,
                     "for OpenSCAD, VALUE in its language; may come again")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--openscad-grid", options.openscad_grid,
                      "with the rounded numbers of OpenSCAD's CGAL: for comparison only");
    command->add_flag("--watch", options.watch,
                      "evaluate again whenever the program or a file that it reads changes, until "
                      "interrupted; only what changed is evaluated");
    command->add_flag("--missing-files-empty", options.missing_files_are_empty,
                      "a file that is not there is an empty set, with a remark, not an error");
    command->add_flag("--keep-going", options.keep_going,
                      "shapes that are refused are left out, with a remark, and so are missing "
                      "files");
    command->add_flag("!--no-certificate", options.certificate,
                      "do not check the rounded result for self-intersection; --watch never does");
    command->add_flag(
        "--summary", options.summary,
        "also nodes by name, subtrees found again by content, volume, memory and time");
}

namespace {

/// What a user of the file must hear of.
void say_certificate(Session& session, const EvalOptions& options, const EvalCertificate& made) {
    if (made.certificate && !made.certificate->holds())
        session.note(options.output + ": certified " + to_text(*made.certificate));
    if (made.mending) session.note(options.output + ": " + to_text(*made.mending));
}

void say_remarks(Session& session, const CsgReport& report) {
    for (const std::string& remark : report.remarks) session.note(remark);
    if (report.is_flat)
        session.note("the program describes a region of the plane: its prism of height 1");
}

CsgOptions how_to_evaluate(Session& session, const EvalOptions& options,
                           const ProgramSource& source, bool keeps_colors) {
    CsgOptions how;
    how.evaluate = session.evaluation_options(OperandOptions());
    how.folder = source.folder();
    how.missing_files_are_empty = options.missing_files_are_empty || options.keep_going;
    how.leaves_out_refused = options.keep_going;
    how.keeps_colors = keeps_colors;
    if (session.supervisor().draws())
        how.on_progress = [&session](const CsgProgress& progress) {
            session.supervisor().show_detail(progress_text(progress));
        };
    return how;
}

// One evaluation, from the text to the output. Without measures, which take longer than an edit.
Outcome eval_again(Session& session, const EvalOptions& options, ProgramSource& source,
                   CsgSession& kept, ChangeReport& change) {
    const CsgTree tree = source.read();
    CsgReport report;
    const Solid solid = session.interruptible_stage(
        "evaluate", [&] { return kept.evaluate(tree, &report, &change); });
    say_remarks(session, report);
    const ExactMesh exact =
        session.interruptible_stage("assemble", [&] { return solid.to_exact_mesh(); });
    const PolygonMesh mesh = to_polygon_mesh(exact);
    session.stage(
        "write", [&] { write_result(session, options.output, solid, mesh, exact.source, report); });
    Outcome out;
    out.document = document_of(options, report);
    out.document["triangles"] = mesh.face_count();
    out.document["seconds"] = session.seconds();
    return out;
}

// Seconds that a stage took since `before`.
double seconds_in(const Session& session, const Json& before, const std::string& stage) {
    return session.seconds().value(stage, 0.0) - before.value(stage, 0.0);
}

std::string said_of(const Session& session, const Json& before, const ChangeReport& change) {
    const std::string what = change.evaluated_all
                                 ? "all of it"
                                 : fmt::format("{} shapes changed", change.changed_operands);
    return fmt::format("evaluated in {:.3f} s ({}), assembled in {:.3f} s, written in {:.3f} s",
                       seconds_in(session, before, "evaluate"), what,
                       seconds_in(session, before, "assemble"),
                       seconds_in(session, before, "write"));
}

// Evaluates whenever the program or a file that it reads has changed, until it is interrupted. What
// is wrong with a program is said, and the output of the last one stays.
Outcome watch(Session& session, const EvalOptions& options, ProgramSource& source) {
    const bool keeps_colors =
        is_mesh(options.output) && holds_colors(output_format(session, options.output));
    CsgSession kept(how_to_evaluate(session, options, source, keeps_colors));
    Outcome last;
    try {
        while (true) {
            const Json before = session.seconds();
            try {
                ChangeReport change;
                last = eval_again(session, options, source, kept, change);
                session.note(said_of(session, before, change));
            } catch (const CancelledError&) {
                throw;
            } catch (const Error& error) {
                session.note(error.what());
            }
            session.interruptible_stage("wait", [&] {
                while (!session.supervisor().stop_flag() && !source.has_changed() &&
                       !kept.have_files_changed())
                    std::this_thread::sleep_for(std::chrono::milliseconds(50));
                return true;
            });
        }
    } catch (const CancelledError&) {
        return last;
    }
}

void check_options(const EvalOptions& options) {
    const bool writes_program = has_program_name(options.output);
    if (options.watch && (options.input == "-" || options.output == "-" || options.summary ||
                          writes_program || options.openscad_grid))
        throw UsageError(
            "--watch takes files, not the standard input or output, writes solids, and takes no "
            "--summary and no --openscad-grid");
    if (writes_program && (options.summary || options.openscad_grid))
        throw UsageError("a program is written as it is: no --summary and no --openscad-grid");
}

Outcome program_written(Session& session, const EvalOptions& options, const CsgTree& tree) {
    session.stage("write", [&] { write_program(session, options, tree); });
    Outcome out;
    out.document = document_of(options, tree);
    out.document["seconds"] = session.seconds();
    return out;
}

Solid evaluated(Session& session, const EvalOptions& options, const ProgramSource& source,
                const CsgTree& tree, CsgReport& report) {
    const CsgOptions how =
        how_to_evaluate(session, options, source, keeps_colors(session, options, tree));
    if (options.openscad_grid)
        session.note(
            "the numbers are those of OpenSCAD's CGAL, rounded to its grid: for comparison only");
    return session.interruptible_stage("evaluate", [&] {
        return options.openscad_grid ? evaluate_on_openscad_grid(tree, how, &report)
                                     : evaluate_csg(tree, how, &report);
    });
}

}  // namespace

Outcome run_eval(Session& session, const EvalOptions& options) {
    check_options(options);
    ProgramSource source(session, options);
    const bool writes_program = has_program_name(options.output);
    if (!writes_program && is_mesh(options.output)) (void)output_format(session, options.output);
    check_outputs(session, {options.output});
    session.plan(source.stages() + (writes_program ? 1 : 4));
    if (options.watch) return watch(session, options, source);
    const CsgTree tree = source.read();
    if (writes_program) return program_written(session, options, tree);
    CsgReport report;
    const Solid solid = evaluated(session, options, source, tree, report);
    say_remarks(session, report);
    Outcome out;
    out.document = document_of(options, report);
    // Assembled once: measures and the output take the same triangles.
    ExactMesh mesh = session.interruptible_stage("measure", [&] {
        ExactMesh boundary = solid.to_exact_mesh();
        out.document["triangles"] = boundary.triangles.size();
        out.document["volume"] = volume(boundary);
        if (options.openscad_grid)
            out.document["exact_volume"] = exact_volume(boundary).to_string();
        return boundary;
    });
    if (mesh.triangles.empty()) session.note("the solid is empty");
    PolygonMesh rounded = to_polygon_mesh(mesh);
    const EvalCertificate made = session.interruptible_stage(
        "certify", [&] { return certified(session, options, mesh, rounded); });
    say_certificate(session, options, made);
    out.document["certificate"] = made.certificate ? to_json(*made.certificate) : Json();
    out.document["divided"] = made.mending ? made.mending->divided : 0;
    out.document["mended"] = to_json(made.mending);
    session.stage("write", [&] {
        write_result(session, options.output, solid, rounded, mesh.source, report);
    });
    out.document["seconds"] = session.seconds();
    add_peak_memory(out.document);
    if (options.summary) out.remarks = summary_of(report, out.document);
    return out;
}

}  // namespace trisect::app
