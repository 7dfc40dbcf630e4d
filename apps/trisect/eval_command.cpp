// SPDX-License-Identifier: Apache-2.0
//
// eval MODEL.csg -o OUT: the set that a program in OpenSCAD's evaluated form describes.
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_session.h>
#include <trisect/kernel/error.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "certificate.h"
#include "commands.h"
#include "eval_model.h"
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

// A file as it was when this was made.
class WatchedFile {
public:
    explicit WatchedFile(const std::string& name) : name_(name), was_(state()) {}
    [[nodiscard]] bool has_changed() const { return state() != was_; }

private:
    using State = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
    [[nodiscard]] State state() const {
        std::error_code none;
        return {std::filesystem::last_write_time(name_, none),
                std::filesystem::file_size(name_, none)};
    }
    std::filesystem::path name_;
    State was_;
};

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
                     "mesh, exact boundary (.exact) or native file (.trisect); '-' is the standard "
                     "output")
        ->required();
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
    command->add_flag("--summary", options.summary,
                      "also numbers of nodes and shapes, volume and time");
}

namespace {

Json document_of(const EvalOptions& options, const CsgReport& report) {
    Json out;
    out["schema"] = "trisect.eval/1";
    out["input"] = options.input;
    out["output"] = options.output;
    out["nodes"] = report.nodes;
    out["shapes"] = report.leaves;
    out["different_shapes"] = report.meshes;
    out["formulas"] = report.evaluations;
    out["flat"] = report.is_flat;
    out["remarks"] = report.remarks;
    return out;
}

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

// One evaluation, from the text to the output. Without measures, which take longer than an edit.
Outcome eval_again(Session& session, const EvalOptions& options, CsgSession& kept,
                   ChangeReport& change) {
    const CsgTree tree = session.stage("read", [&] { return read_program(options.input); });
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
Outcome watch(Session& session, const EvalOptions& options) {
    CsgOptions how;
    how.evaluate = session.evaluation_options(OperandOptions());
    how.missing_files_are_empty = options.missing_files_are_empty || options.keep_going;
    how.leaves_out_refused = options.keep_going;
    how.keeps_colors =
        is_mesh(options.output) && holds_colors(output_format(session, options.output));
    CsgSession kept(how);
    Outcome last;
    try {
        while (true) {
            const WatchedFile program(options.input);
            const Json before = session.seconds();
            try {
                ChangeReport change;
                last = eval_again(session, options, kept, change);
                session.note(said_of(session, before, change));
            } catch (const CancelledError&) {
                throw;
            } catch (const Error& error) {
                session.note(error.what());
            }
            session.interruptible_stage("wait", [&] {
                while (!session.supervisor().stop_flag() && !program.has_changed() &&
                       !kept.have_files_changed())
                    std::this_thread::sleep_for(std::chrono::milliseconds(50));
                return true;
            });
        }
    } catch (const CancelledError&) {
        return last;
    }
}

}  // namespace

Outcome run_eval(Session& session, const EvalOptions& options) {
    if (is_mesh(options.output)) (void)output_format(session, options.output);
    check_outputs(session, {options.output});
    session.plan(5);
    if (options.watch) {
        if (options.input == "-" || options.output == "-" || options.summary)
            throw UsageError(
                "--watch takes files, not the standard input or output, and no "
                "--summary");
        return watch(session, options);
    }
    const CsgTree tree = session.stage("read", [&] { return read_program(options.input); });
    CsgReport report;
    const Solid solid = session.interruptible_stage("evaluate", [&] {
        CsgOptions how;
        how.evaluate = session.evaluation_options(OperandOptions());
        how.missing_files_are_empty = options.missing_files_are_empty || options.keep_going;
        how.leaves_out_refused = options.keep_going;
        how.keeps_colors = keeps_colors(session, options, tree);
        return evaluate_csg(tree, how, &report);
    });
    say_remarks(session, report);
    Outcome out;
    out.document = document_of(options, report);
    // Assembled once: measures and the output take the same triangles.
    ExactMesh mesh = session.interruptible_stage("measure", [&] {
        ExactMesh boundary = solid.to_exact_mesh();
        out.document["triangles"] = boundary.triangles.size();
        out.document["volume"] = volume(boundary);
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
    if (options.summary) out.remarks = summary_of(report, out.document);
    return out;
}

}  // namespace trisect::app
