// SPDX-License-Identifier: Apache-2.0
//
// check A: does the mesh bound a solid? Every defect with its place, and what else there is to say
// about the file.
#include <trisect/brep/validate/validate.h>

#include <fmt/format.h>

#include <span>

#include "commands.h"
#include "mesh_files.h"
#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

std::string answer_text(const ValidationReport& report, std::span<const FileRemark> remarks,
                        const std::string& name) {
    if (report.empty() && remarks.empty()) {
        return fmt::format("{}: a solid, nothing found\n", name);
    }
    std::string out;
    for (const FileRemark& remark : remarks) {
        out += fmt::format("remark: {} {}\n  {}\n", remark.count, name_of(remark.kind),
                           remark.sentence);
    }
    out += report.to_string();
    if (!out.empty() && out.back() != '\n') out += '\n';
    return out + fmt::format("{}: {}; {} errors, {} warnings, {} remarks\n", name,
                             report.is_solid() ? "a solid" : "not a solid",
                             report.count(Severity::Error), report.count(Severity::Warning),
                             remarks.size());
}

}  // namespace

void add_check_command(CLI::App& app, CheckOptions& options) {
    CLI::App* command =
        app.add_subcommand("check", "does a mesh bound a solid? exit code 1 if anything is found");
    command->add_option("A", options.input, "mesh file")->required();
    command
        ->add_option_function<std::string>(
            "--places",
            [&options](const std::string& text) {
                const std::int64_t n = parse_integer(text, "--places");
                if (n < 0) throw UsageError("--places: must not be negative");
                options.places = static_cast<std::uint64_t>(n);
            },
            "defects listed of each kind (default 100)")
        ->type_name("N");
}

Outcome run_check(Session& session, const CheckOptions& options) {
    session.plan(2);
    const auto [mesh, remarks] =
        session.stage("read", [&] { return read_input_with_remarks(session, options.input); });
    ValidateOptions validation;
    validation.list_limit = options.places;
    if (session.options().lattice) validation.lattice = Lattice{*session.options().lattice};
    const ValidationReport report = session.stage(
        "check", [&, &shape = mesh] { return validate_input(shape, options.input, validation); });
    const LatticeReport& lattice = report.lattice();
    note_rounding(session, lattice, options.input);
    Outcome out;
    out.code = report.empty() && remarks.empty() ? exit_done : exit_findings;
    out.document["schema"] = "trisect.check/1";
    out.document["file"] = options.input;
    out.document["solid"] = report.is_solid();
    out.document["errors"] = report.count(Severity::Error);
    out.document["warnings"] = report.count(Severity::Warning);
    out.document["counts"] = defect_counts_json(report);
    out.document["defects"] = defects_json(report);
    out.document["remarks"] = remarks_json(remarks);
    out.document["lattice"] = lattice_json(lattice);
    out.document["seconds"] = session.seconds();
    out.answer = answer_text(report, remarks, options.input);
    return out;
}

}  // namespace trisect::app
