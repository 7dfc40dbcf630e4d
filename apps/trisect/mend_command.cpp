// SPDX-License-Identifier: Apache-2.0
//
// mend A -o B: turns faces and shells, closes seams, drops duplicates and fills planar holes, each
// where it is asked for. The outcome is written whether or not it bounds a solid: what was mended
// may be one of several steps. Exit code 1 says that the boundary is not closed, or inside out.
#include <trisect/brep/mend/mend.h>

#include <fmt/format.h>

#include <string>
#include <utility>

#include "choice.h"
#include "commands.h"
#include "import_notes.h"
#include "mend_report.h"
#include "mended_part.h"
#include "mesh_files.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {
namespace {

double distance_of(const std::string& text, const char* name) {
    const double d = parse_number(text, name);
    if (d < 0) throw UsageError(std::string(name) + ": must not be negative");
    return d;
}

/// Kinds of mending are for meshes of files, and so is the outcome.
void check_request(const MendCommandOptions& options) {
    if (!options.what.any())
        throw UsageError(
            "mend: nothing is asked for; --orient turns faces, --shells shells, --seams D closes "
            "seams up to D, --drop leaves duplicate faces out, --fill fills planar holes, --all D "
            "does all of these but the last");
    if (has_exact_boundary(options.input) || has_native_name(options.input))
        throw UsageError(options.input + ": mend is for meshes; this is the boundary of a solid");
    if (has_lossless_name(options.output))
        throw UsageError(
            options.output +
            ": mend writes meshes; 'trisect convert' makes a solid of one that closes");
}

/// What import has to say about the outcome.
struct Closure {
    bool closed = false;
    bool inside_out = false;
    [[nodiscard]] bool bounds_a_solid() const { return closed && !inside_out; }
};

Closure closure_of(const Session& session, const PolygonMesh& mesh, const std::string& name) {
    const ImportReport report = import_input(session, mesh, name).report;
    return {report.closed, report.inside_out};
}

std::string verdict_of(const Closure& closure) {
    if (!closure.closed) return "the boundary is not closed";
    if (closure.inside_out) return "the boundary is closed, and inside out";
    return "the boundary is closed ('trisect check' looks whether it meets itself)";
}

}  // namespace

void add_mend_command(CLI::App& app, MendCommandOptions& options) {
    CLI::App* command = app.add_subcommand(
        "mend", "turn faces and shells, close seams, drop duplicates; nothing unless asked for");
    MendOptions& what = options.what;
    command->add_option("A", options.input, "mesh file; its parts become one mesh")->required();
    command->add_option("-o,--output", options.output, "mesh; '-' is the standard output")
        ->required();
    command->add_flag("--orient", what.orient_faces,
                      "turn faces over so that each edge of two faces is used once each way");
    command->add_flag(
        "--shells", what.orient_shells,
        "turn shells over so that each bounds its inside, or a cavity within another");
    add_choice_option<InnerShells>(
        *command, "--inner", what.inner_shells,
        {{"cavities", InnerShells::Cavities}, {"material", InnerShells::Material}},
        "what shells within others bound, for --shells (default cavities)");
    command
        ->add_option_function<std::string>(
            "--seams", [&what](const std::string& s) { what.seams = distance_of(s, "--seams"); },
            "join vertices of open edges up to this distance, and put them into open edges; 0 puts "
            "in those that are on them")
        ->type_name("D");
    command->add_flag("--drop", what.drop_duplicates, "leave out faces with the corners of others");
    command->add_flag("--fill", what.fill_planar_holes,
                      "add faces where open edges are a loop in a plane, exactly");
    command
        ->add_option_function<std::string>(
            "--all",
            [&what](const std::string& s) {
                what.seams = distance_of(s, "--all");
                what.orient_faces = what.orient_shells = what.drop_duplicates = true;
            },
            "--orient --shells --drop --seams D")
        ->type_name("D");
    add_properties_option(*command, options.properties);
    command
        ->add_option_function<std::string>(
            "--places",
            [&options](const std::string& text) {
                const std::int64_t n = parse_integer(text, "--places");
                if (n < 0) throw UsageError("--places: must not be negative");
                options.places = static_cast<std::uint64_t>(n);
            },
            "listed faces, vertices and places of each kind, with --json (default 100)")
        ->type_name("N");
}

Outcome run_mend(Session& session, const MendCommandOptions& options) {
    check_request(options);
    const MeshFormat format = output_format(session, options.output);
    if (options.properties) check_holds_properties(options.output, format);
    check_outputs(session, {options.output});
    session.plan(4);
    Model model = session.stage("read", [&] {
        return one_part(read_input_model(session, options.input, options.properties).model);
    });
    const PolygonMesh& mesh = model.parts.front().mesh;
    MendOptions what = options.what;
    if (session.options().lattice) what.lattice = Lattice{*session.options().lattice};
    MendedMesh out_mesh = session.interruptible_stage("mend", [&] {
        try {
            return mended(mesh, what);
        } catch (const LimitError& e) {
            throw OperandError(e.code(), options.input, e.what());
        }
    });
    note_rounding(session, out_mesh.report.lattice, options.input);
    const Closure closure =
        session.stage("check", [&] { return closure_of(session, out_mesh.mesh, options.output); });
    const std::size_t vertices = out_mesh.mesh.points.size();
    const std::size_t faces = out_mesh.mesh.face_count();
    const MendReport report = out_mesh.report;
    session.stage("write", [&] {
        if (!options.properties) {
            write_output_mesh(session, options.output, format, out_mesh.mesh);
            return;
        }
        ModelPart part = mended_part(model.parts.front(), std::move(out_mesh));
        model.parts.front() = std::move(part);
        write_output_model(session, options.output, format, std::move(model), true);
    });
    Outcome out;
    out.code = closure.bounds_a_solid() ? exit_done : exit_findings;
    out.document["schema"] = "trisect.mend/1";
    out.document["input"] = options.input;
    out.document["output"] = options.output;
    out.document["format"] = to_string(format);
    out.document["vertices"] = vertices;
    out.document["faces"] = faces;
    out.document["closed"] = closure.closed;
    out.document["inside_out"] = closure.inside_out;
    out.document["mended"] = mend_json(report, options.places);
    out.document["seconds"] = session.seconds();
    out.remarks = mend_text(report) + fmt::format("{:<13}{}", "now", verdict_of(closure));
    return out;
}

}  // namespace trisect::app
